// What is loaded: program, positions, as-machined surface, passes, defects.

import { baseName, element } from './dom';
import { FilterBar, keeps } from './filters';
import type { Defect, Manifest } from './manifest';
import { showFormed, type State, type Store } from './store';
import { Kind, type Surface } from './surface';

const mostPasses = 1000;
const mostDefects = 500;
/** Below its neighbours, above them, or both in turn. */
const shapeSigns: Record<string, string> = { pit: '▾ ', bulge: '▴ ', alternating: '± ' };

/** How deep a defect is; of one without a depth how much slower or faster the pass is. */
function sizeOf(defect: Defect): string {
    if (defect.shape === 'none' && defect.speed_percent !== null)
        return `${defect.speed_percent < 0 ? '−' : '+'}${Math.abs(defect.speed_percent).toFixed(0)} %`;
    if (defect.depth_um === null) return '';
    return `${shapeSigns[defect.shape] ?? ''}${defect.depth_um.toFixed(1)} µm`;
}

/** Below a list that is not whole. */
function moreHint(more: number): HTMLElement {
    return element('p', { class: 'hint' }, `${more} more: see the table of defects, or filter the list`);
}

export class TreePane {
    readonly element = element('nav', { class: 'tree', 'aria-label': 'contents' });
    private readonly passes = element('details', { class: 'passes' });
    private readonly defectList = element('div', { class: 'list' });
    private readonly defectCount = element('summary');

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly surface: () => Surface,
        private readonly handlers: { goToDefect: (index: number) => void; goToGone: (index: number) => void },
        formed: boolean,
    ) {
        const { program, surfaces } = manifest;
        this.element.append(
            element(
                'div',
                { class: 'node', title: program.name },
                element('b', {}, baseName(program.name)),
                element('small', {}, `${program.lines.toLocaleString('en')} lines`),
            ),
            ...surfaces.map((s, k) =>
                element(
                    'div',
                    { class: 'node', title: s.log },
                    element('b', {}, baseName(s.log)),
                    element(
                        'small',
                        {},
                        surfaces.length > 1
                            ? k === 0
                                ? 'after'
                                : 'before'
                            : `${s.records.toLocaleString('en')} points`,
                    ),
                ),
            ),
            this.positions(formed),
            this.motions(),
            this.defects(),
            ...this.gone(),
            this.passes,
        );
        this.fillPasses();
        this.update(store.state);
        store.on((state, changed) => {
            if (changed.has('shown')) this.fillPasses();
            if (changed.has('filter') || changed.has('accepted')) this.filterDefects();
            this.update(state);
        });
    }

    /** A button that is pressed while what it names is shown. */
    private choice(text: string, key: string, title: string, act: () => void): HTMLElement {
        const button = element('button', { 'data-choice': key, title }, text);
        button.addEventListener('click', act);
        return button;
    }

    private positions(formed: boolean): HTMLElement {
        const list = element('div', { class: 'choices' });
        const names = [this.manifest.surfaces[0].role, ...this.manifest.surfaces[0].roles.map((r) => r.name)];
        names.forEach((name, role) =>
            list.append(
                this.choice(name, `role-${role}`, `the surface of the ${name} positions`, () =>
                    this.store.set({ role, formed: false }),
                ),
            ),
        );
        if (formed)
            list.append(
                this.choice('formed', 'formed', 'the as-machined surface, above its form', () =>
                    this.store.set(showFormed(this.store.state)),
                ),
            );
        return element('div', { class: 'group' }, element('h2', {}, 'Surface'), list);
    }

    /** Which kinds of motion are drawn. */
    private motions(): HTMLElement {
        const list = element('div', { class: 'choices' });
        const surface = this.surface();
        for (const [name, kind, what] of [
            ['cuts', Kind.cut, 'cutting passes'],
            ['links', Kind.link, 'motions at feed between passes'],
            ['rapids', Kind.rapid, 'rapid motions'],
        ] as const) {
            if (!surface.kinds.some((_, i) => surface.kind(i) === kind)) continue;
            list.append(
                this.choice(name, `kind-${kind}`, `draw ${what}`, () =>
                    this.store.set({ kinds: this.store.state.kinds ^ (1 << kind) }),
                ),
            );
        }
        if (this.manifest.programmed)
            list.append(
                this.choice('programmed', 'programmed', 'draw the programmed path in thin lines', () =>
                    this.store.set({ programmed: !this.store.state.programmed }),
                ),
            );
        return element('div', { class: 'group' }, element('h2', {}, 'Motion'), list);
    }

    private defects(): HTMLElement {
        const { defects } = this.manifest;
        this.filterDefects();
        const filters = element('details', { class: 'filter' }, element('summary', {}, 'Filter'));
        filters.append(new FilterBar(this.manifest, this.store, 'of the list').element);
        return element(
            'details',
            { open: '' },
            this.defectCount,
            ...(defects.length > 0 ? [filters, this.defectList] : [element('p', { class: 'hint' }, 'none')]),
        );
    }

    /** Defects of the log before that are there no more. */
    private gone(): HTMLElement[] {
        const { gone } = this.manifest;
        if (gone.length === 0) return [];
        const list = element('div', { class: 'list' });
        gone.slice(0, mostDefects).forEach((defect, k) => {
            const button = element(
                'button',
                { class: 'item', 'data-choice': `gone-${k}`, title: defect.text },
                element('span', { class: `severity s${defect.severity}` }, String(defect.id)),
                element('span', {}, defect.cause.replace('_', ' ')),
                element('small', {}, 'gone'),
            );
            button.addEventListener('click', () => this.handlers.goToGone(k));
            list.append(button);
        });
        if (gone.length > mostDefects) list.append(moreHint(gone.length - mostDefects));
        return [element('details', {}, element('summary', {}, `Gone (${gone.length})`), list)];
    }

    private defectItem(defect: Defect, index: number): HTMLElement {
        const size = sizeOf(defect);
        const button = element(
            'button',
            { class: 'item', 'data-choice': `defect-${index}`, title: defect.text },
            element(
                'span',
                { class: `severity s${defect.severity}`, title: `severity ${defect.severity} of 4` },
                String(defect.id),
            ),
            element('span', {}, defect.cause.replace('_', ' ')),
            element('small', {}, defect.change === 'new' ? `new ${size}` : size),
        );
        button.classList.toggle('accepted', this.store.state.accepted.get(defect.id)?.accepted === true);
        button.addEventListener('click', () => this.handlers.goToDefect(index));
        return button;
    }

    private filterDefects(): void {
        const { defects } = this.manifest;
        const kept = [...defects.entries()].filter(([, defect]) => keeps(this.store.state, defect));
        this.defectList.replaceChildren(
            ...kept.slice(0, mostDefects).map(([index, defect]) => this.defectItem(defect, index)),
            ...(kept.length > mostDefects ? [moreHint(kept.length - mostDefects)] : []),
        );
        this.defectCount.textContent =
            kept.length < defects.length ? `Defects (${kept.length} of ${defects.length})` : `Defects (${kept.length})`;
    }

    /** From which pass to which the surface is drawn. */
    private passRange(count: number): HTMLElement {
        const box = (name: string, value: number) =>
            element('input', {
                type: 'number',
                min: '1',
                max: String(count),
                value: String(value),
                'aria-label': `${name} pass drawn`,
            });
        const [first, last] = (this.store.state.passes ?? [1, count]).map((n) => Math.min(n, count));
        const [from, to] = [box('first', first), box('last', last)];
        const change = () => {
            const [a, b] = [Number(from.value), Number(to.value)].map((n) =>
                Math.min(count, Math.max(1, Math.round(n))),
            );
            this.store.set({ passes: a > b || (a === 1 && b === count) ? null : [a, b] });
        };
        for (const input of [from, to]) input.addEventListener('change', change);
        return element('p', { class: 'range-of-passes' }, 'draw ', from, ' to ', to);
    }

    private fillPasses(): void {
        const surface = this.surface();
        const count = surface.info.pass_count;
        const list = element('div', { class: 'list' });
        for (let n = 1; n <= Math.min(count, mostPasses); ++n) {
            const button = element(
                'button',
                { class: 'item', 'data-choice': `pass-${n}` },
                element('span', {}, `pass ${n}`),
                element('small', {}, `from point ${surface.passes[2 * n - 2]}`),
            );
            button.addEventListener('click', () => {
                const vertex = surface.vertexOfPoint(surface.passes[2 * n - 2]);
                this.store.set({ pass: n, vertex, line: surface.line[vertex], defect: null });
            });
            list.append(button);
        }
        if (count > mostPasses)
            list.append(element('p', { class: 'hint' }, `${count - mostPasses} more: click the surface`));
        this.passes.replaceChildren(
            element('summary', {}, `Passes (${count.toLocaleString('en')})`),
            ...(count > 1 ? [this.passRange(count)] : []),
            list,
        );
    }

    private update(state: Readonly<State>): void {
        const chosen = new Set([
            state.formed ? 'formed' : `role-${state.role}`,
            `defect-${state.defect}`,
            `pass-${state.pass}`,
            state.programmed ? 'programmed' : '',
            ...[Kind.cut, Kind.link, Kind.rapid].filter((k) => (state.kinds >> k) & 1).map((k) => `kind-${k}`),
        ]);
        for (const button of this.element.querySelectorAll<HTMLElement>('[data-choice]')) {
            button.setAttribute('aria-pressed', String(chosen.has(button.dataset.choice ?? '')));
        }
    }
}
