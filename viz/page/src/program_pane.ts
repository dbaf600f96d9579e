// The program's text, only the rows that are seen: half a million lines scroll as one does.

import { element } from './dom';
import type { Manifest } from './manifest';
import type { ProgramText } from './program_text';
import { RowWindow } from './row_window';
import type { Store } from './store';
import type { Surface } from './surface';

export class ProgramPane {
    readonly element = element('div', {
        class: 'program',
        tabindex: '0',
        role: 'listbox',
        'aria-label': 'the program; arrow keys move from line to line',
    });
    private readonly rows = element('div', { class: 'rows' });
    private readonly marks = new Map<number, string>(); // class of lines of the defect that is chosen
    private readonly window: RowWindow;

    constructor(
        manifest: Manifest,
        private readonly text: ProgramText,
        private readonly store: Store,
        private readonly surface: () => Surface,
    ) {
        const spacer = element('div');
        this.element.append(spacer, this.rows);
        this.window = new RowWindow(
            this.element,
            spacer,
            this.rows,
            () => this.text.lineCount,
            (begin, end) => this.fill(begin, end),
        );
        // The card of a defect may take a part of the room: the chosen line stays in the rest.
        new ResizeObserver(() => {
            if (store.state.line > 0) this.window.reveal(store.state.line - 1);
        }).observe(this.element);
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
                    [defect?.neighbours ?? [], 'adjacent'],
                    [defect?.runs ?? [], 'fault'],
                ] as const) {
                    for (const run of runs)
                        for (let n = run.lines[0]; n > 0 && n <= Math.min(run.lines[1], run.lines[0] + 5000); ++n)
                            this.marks.set(n, name);
                }
            }
            if (changed.has('line') && state.line > 0) this.window.reveal(state.line - 1);
            if (changed.has('line') || changed.has('defect')) this.window.draw();
        });
    }

    /** The first point of the line, where it has one; else the line alone. */
    private choose(line: number): void {
        const runs = this.surface().runsOfLine(line);
        this.store.set({ line, vertex: runs.length > 0 ? runs[0][0] : null, defect: null, pass: 0 });
    }

    private fill(begin: number, end: number): HTMLElement[] {
        const made: HTMLElement[] = [];
        for (let n = begin + 1; n <= end; ++n) {
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
        return made;
    }
}
