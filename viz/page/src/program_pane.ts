// The program's text, only the rows that are seen: half a million lines scroll as one does.

import { element, oncePerFrame } from './dom';
import type { Manifest } from './manifest';
import type { ProgramText } from './program_text';
import type { Store } from './store';
import type { Surface } from './surface';

const rowHeight = 19;
const tallest = 8_000_000; // px that every browser's scroll bar can have

export class ProgramPane {
    readonly element = element('div', {
        class: 'program',
        tabindex: '0',
        role: 'listbox',
        'aria-label': 'the program; arrow keys move from line to line',
    });
    private readonly spacer = element('div');
    private readonly rows = element('div', { class: 'rows' });
    private readonly marks = new Map<number, string>(); // class of lines of the defect that is chosen
    private readonly draw = oncePerFrame(() => this.drawNow());

    constructor(
        manifest: Manifest,
        private readonly text: ProgramText,
        private readonly store: Store,
        private readonly surface: () => Surface,
    ) {
        this.element.append(this.spacer, this.rows);
        this.spacer.style.height = `${this.height}px`;
        this.element.addEventListener('scroll', () => this.draw());
        new ResizeObserver(() => this.draw()).observe(this.element);
        this.rows.addEventListener('click', (event) => {
            const row = (event.target as HTMLElement).closest<HTMLElement>('[data-line]');
            if (row) this.choose(Number(row.dataset.line));
        });
        this.element.addEventListener('keydown', (event) => {
            const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 20, PageUp: -20 }[event.key];
            if (!step) return;
            event.preventDefault();
            this.choose(Math.min(this.text.lineCount, Math.max(1, store.state.line + step)));
        });
        store.on((state, changed) => {
            if (changed.has('defect')) {
                this.marks.clear();
                const defect = state.defect === null ? null : manifest.defects[state.defect];
                for (const [runs, name] of [
                    [defect?.neighbours ?? [], 'beside'],
                    [defect?.runs ?? [], 'fault'],
                ] as const) {
                    for (const run of runs)
                        for (let n = run.lines[0]; n > 0 && n <= Math.min(run.lines[1], run.lines[0] + 5000); ++n)
                            this.marks.set(n, name);
                }
            }
            if (changed.has('line') && state.line > 0) this.reveal(state.line);
            if (changed.has('line') || changed.has('defect')) this.draw();
        });
    }

    private get height(): number {
        return Math.min(tallest, this.text.lineCount * rowHeight);
    }
    /** Lines a pixel of the scroll bar moves, beyond one for one where the text is taller than it can be. */
    private get first(): number {
        const room = this.height - this.element.clientHeight;
        const lines = this.text.lineCount - this.element.clientHeight / rowHeight;
        return room > 0 ? Math.max(0, (this.element.scrollTop / room) * lines) : 0;
    }

    /** The first point of the line, where it has one; else the line alone. */
    private choose(line: number): void {
        const runs = this.surface().runsOfLine(line);
        this.store.set({ line, vertex: runs.length > 0 ? runs[0][0] : null, defect: null, pass: 0 });
    }

    reveal(line: number): void {
        const seen = this.element.clientHeight / rowHeight;
        if (line - 1 >= this.first + 1 && line <= this.first + seen - 1) return;
        const lines = this.text.lineCount - seen;
        const room = this.height - this.element.clientHeight;
        if (lines > 0) this.element.scrollTop = (Math.max(0, Math.min(lines, line - 1 - seen / 2)) / lines) * room;
        this.drawNow(); // in this frame: while the tool moves there is a jump in each
    }

    private drawNow(): void {
        const first = this.first;
        const begin = Math.floor(first);
        const count = Math.ceil(this.element.clientHeight / rowHeight) + 1;
        const made: HTMLElement[] = [];
        for (let n = begin + 1; n <= Math.min(this.text.lineCount, begin + count); ++n) {
            const chosen = n === this.store.state.line;
            const row = element('div', {
                class: `row ${this.marks.get(n) ?? ''} ${chosen ? 'chosen' : ''}`,
                'data-line': String(n),
                role: 'option',
                'aria-selected': String(chosen),
            });
            row.append(
                element('span', { class: 'number' }, String(n)),
                element('code', { dir: 'ltr' }, this.text.line(n)),
            );
            made.push(row);
        }
        this.rows.replaceChildren(...made);
        this.rows.style.transform = `translateY(${this.element.scrollTop - (first - begin) * rowHeight}px)`;
    }
}
