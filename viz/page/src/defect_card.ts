// The card of a defect over the view: it stays while other places are looked at, until it is closed.

import { withOpinion } from './accepted';
import { fixedText, signedText } from './decimal_text';
import { element } from './dom';
import type { Defect, DefectRun, Manifest } from './manifest';
import type { Store } from './store';

const mostRuns = 6; // of a list of lines
const oneColumn = matchMedia('(max-width: 700px)'); // as in style/phone.css

export interface CardHandlers {
    step: (by: number) => void;
    goToLine: (line: number) => void;
    goToDefect: (index: number) => void;
    print: (index: number) => void;
}

/** What a defect is measured by, as it stands on its card. */
export function factsOf(defect: Defect): [string, string][] {
    const facts: [string, string][] = [];
    const { speed_percent: speed, depth_um: depth, formed_um: formed, length_mm: length } = defect;
    if (speed !== null) facts.push(['Speed', `${signedText(speed, 1)} %`]);
    if (depth !== null)
        facts.push(['Depth', `${depth.toFixed(1)} µm${defect.shape === 'none' ? '' : ` ${defect.shape}`}`]);
    if (formed !== null && formed !== undefined) facts.push(['Formed', `${formed.toFixed(1)} µm`]);
    if (length !== null) facts.push(['Length', `${length.toFixed(1)} mm`]);
    facts.push(['Threshold', `× ${defect.score.toFixed(1)}`]);
    facts.push([defect.contact_mm ? 'Contact' : 'Tool tip', defect.position_mm.map((c) => fixedText(c, 2)).join(' ')]);
    return facts;
}

export class DefectCard {
    readonly element = element('section', { class: 'card', 'aria-label': 'defect card', hidden: '' });

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly handlers: CardHandlers,
    ) {
        store.on((_, changed) => {
            if (changed.has('pinned')) this.draw();
            else if (changed.has('accepted') && !this.element.contains(document.activeElement)) this.draw();
        });
    }

    /** Brings it into sight where it stands below the map, and as much of the map as has room. */
    reveal(map: HTMLElement): void {
        if (!oneColumn.matches) return;
        const { top, bottom } = map.getBoundingClientRect();
        if (top < 0 || bottom > innerHeight) map.scrollIntoView();
        this.element.scrollIntoView({ block: 'nearest' });
    }

    private button(name: string, text: string, title: string, act: () => void): HTMLElement {
        const made = element('button', { 'data-action': name, title }, text);
        if (!/\w/.test(text)) made.setAttribute('aria-label', title);
        made.addEventListener('click', act);
        return made;
    }

    private lines(name: string, runs: DefectRun[]): HTMLElement[] {
        const known = runs.filter((run) => run.lines[0] > 0);
        if (known.length === 0) return [];
        const list = element('dd', {});
        for (const { lines } of known.slice(0, mostRuns)) {
            const text = lines[0] === lines[1] ? `${lines[0]}` : `${lines[0]}–${lines[1]}`;
            list.append(
                this.button('card-line', text, `show line ${lines[0]}`, () => this.handlers.goToLine(lines[0])),
                ' ',
            );
        }
        if (known.length > mostRuns)
            list.append(element('span', { class: 'more' }, `and ${known.length - mostRuns} more`));
        return [element('div', { class: 'lines' }, element('dt', {}, name), list)];
    }

    private draw(): void {
        const { pinned } = this.store.state;
        this.element.hidden = pinned === null;
        if (pinned === null) return;
        const defect = this.manifest.defects[pinned];
        const head = element(
            'div',
            { class: 'head' },
            element('span', { class: `severity s${defect.severity}` }, String(defect.id)),
            element('h2', {}, `Defect ${defect.id}`),
            element('small', {}, defect.severity_name),
            this.button('card-previous', '◀', 'the previous defect', () => this.handlers.step(-1)),
            this.button('card-next', '▶', 'the next defect', () => this.handlers.step(1)),
            this.button('card-show', 'Show', 'show the defect again', () => this.handlers.goToDefect(pinned)),
            this.button('card-print', 'Print', 'print this defect with its lines', () => this.handlers.print(pinned)),
            this.button('card-close', '✕', 'close the card', () => this.store.set({ pinned: null, defect: null })),
        );
        const facts = element('dl', {});
        for (const [name, value] of factsOf(defect))
            facts.append(
                element(
                    'div',
                    value.length > 14 ? { class: 'lines' } : {},
                    element('dt', {}, name),
                    element('dd', {}, value),
                ),
            );
        facts.append(...this.lines('Lines', defect.runs), ...this.lines('Adjacent lines', defect.neighbours));
        this.element.replaceChildren(head, element('p', {}, defect.text), facts, this.opinion(defect));
    }

    private opinion(defect: Defect): HTMLElement {
        const known = this.store.state.accepted.get(defect.id);
        const accept = element('input', { type: 'checkbox', name: 'accept' });
        accept.checked = known?.accepted === true;
        const comment = element('textarea', { rows: '2', placeholder: 'comment', 'aria-label': 'comment' });
        comment.value = known?.comment ?? '';
        const change = () => {
            const opinion = { accepted: accept.checked, comment: comment.value.trim() };
            this.store.set({ accepted: withOpinion(this.store.state.accepted, defect.id, opinion) });
        };
        accept.addEventListener('change', change);
        comment.addEventListener('change', change);
        return element('div', { class: 'opinion' }, element('label', {}, accept, ' Accepted'), comment);
    }
}
