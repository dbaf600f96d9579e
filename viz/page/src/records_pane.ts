// The records of the log as a list: one row for each point of the page, with its positions and values, round the cursor.

import { fixedText } from './decimal_text';
import { element } from './dom';
import type { Manifest } from './manifest';
import { RowWindow } from './row_window';
import type { Store } from './store';
import type { Surface } from './surface';

const headerHeight = 50; // px, as .records .head in the style sheet

interface RecordColumn {
    name: string;
    unit: string;
    text: (surface: Surface, vertex: number) => string;
}

/** A place without the sign of a zero. */
const placeText = (value: number) => fixedText(value, 4);

/** Number, time, line and pass, the positions of each role, and all fields. */
function columnsOf(manifest: Manifest, surface: Surface): RecordColumn[] {
    const origin = manifest.surfaces[0].origin_mm;
    const columns: RecordColumn[] = [
        { name: 'Point', unit: '', text: (s, i) => String(s.point[i]) },
        { name: 'Time', unit: 's', text: (s, i) => s.time[i].toFixed(4) },
        { name: 'Line', unit: '', text: (s, i) => (s.line[i] > 0 ? String(s.line[i]) : '–') },
        { name: 'Pass', unit: '', text: (s, i) => String(s.passOf(i) || '–') },
    ];
    surface.roles.forEach((role, r) => {
        for (const [axis, letter] of ['X', 'Y', 'Z'].entries())
            columns.push({
                name: `${letter} ${role.name}`,
                unit: 'mm',
                text: (s, i) => placeText(s.roles[r].xyz[3 * i + axis] + origin[axis]),
            });
    });
    manifest.fields.forEach((field, k) =>
        columns.push({ name: field.label, unit: field.unit, text: (s, i) => s.textOf(k, field.unit, i) }),
    );
    return columns;
}

export class RecordsPane {
    readonly element = element('div', {
        class: 'records',
        tabindex: '0',
        role: 'table',
        'aria-label': 'records of the log; arrow keys move from point to point',
    });
    private readonly head = element('div', { class: 'head', role: 'rowgroup' });
    private readonly rows = element('div', { class: 'rows', role: 'rowgroup' });
    private readonly window: RowWindow;
    private columns: RecordColumn[] = [];

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly surface: () => Surface,
    ) {
        const spacer = element('div', { class: 'spacer', role: 'presentation' });
        this.element.append(this.head, spacer, this.rows);
        this.window = new RowWindow(
            this.element,
            spacer,
            this.rows,
            () => this.surface().count,
            (begin, end) => this.fill(begin, end),
            headerHeight,
        );
        this.rows.addEventListener('click', (event) => {
            const row = (event.target as HTMLElement).closest<HTMLElement>('[data-vertex]');
            if (row) this.choose(Number(row.dataset.vertex));
        });
        this.element.addEventListener('keydown', (event) => {
            const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10 }[event.key];
            if (!step) return;
            event.preventDefault();
            this.choose(Math.min(this.surface().count - 1, Math.max(0, (store.state.vertex ?? 0) + step)));
        });
        store.on((state, changed) => {
            if (changed.has('shown')) this.build();
            if (changed.has('records')) this.show();
            if (!state.records) return;
            if (changed.has('records') || (changed.has('vertex') && state.vertex !== null))
                this.window.reveal(state.vertex ?? 0);
            if (changed.has('vertex') || changed.has('defect')) this.window.draw();
        });
        this.build();
        this.show();
    }

    private show(): void {
        this.element.hidden = !this.store.state.records;
    }

    private build(): void {
        const surface = this.surface();
        this.columns = columnsOf(this.manifest, surface);
        const titles = this.columns.map((column) =>
            element(
                'span',
                { role: 'columnheader', title: column.unit ? `${column.name} [${column.unit}]` : column.name },
                element('b', {}, column.name),
                element('small', {}, column.unit),
            ),
        );
        this.head.replaceChildren(element('div', { class: 'row', role: 'row' }, ...titles));
        this.element.setAttribute('aria-rowcount', String(surface.count + 1));
        this.window.resize();
        this.window.draw();
    }

    private choose(vertex: number): void {
        this.store.set({ vertex, hover: null, line: this.surface().line[vertex], defect: null, pass: 0 });
    }

    private fill(begin: number, end: number): HTMLElement[] {
        const surface = this.surface();
        const made: HTMLElement[] = [];
        for (let i = begin; i < end; ++i) {
            const chosen = i === this.store.state.vertex;
            const row = element('div', {
                class: chosen ? 'row chosen' : 'row',
                role: 'row',
                'aria-rowindex': String(i + 2),
                'data-vertex': String(i),
            });
            for (const column of this.columns) row.append(element('span', { role: 'cell' }, column.text(surface, i)));
            made.push(row);
        }
        return made;
    }
}
