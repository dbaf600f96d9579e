// The numbers of one point: that under the pointer, else that of the cursor.

import { fixedText } from './decimal_text';
import { element } from './dom';
import type { Manifest } from './manifest';
import type { ProgramText } from './program_text';
import type { Store } from './store';
import type { Surface } from './surface';

export class TablePane {
    readonly element = element('div', {
        class: 'table',
        tabindex: '0',
        role: 'region',
        'aria-label': 'values of the point',
    });

    constructor(
        private readonly manifest: Manifest,
        private readonly text: ProgramText,
        private readonly store: Store,
        private readonly surface: () => Surface,
    ) {
        store.on((_, changed) => {
            if (changed.has('vertex') || changed.has('hover') || changed.has('role') || changed.has('shown'))
                this.draw();
        });
        this.draw();
    }

    /** Why the tool is slow there, where the page knows it of any point. */
    private slowRow(surface: Surface, vertex: number): HTMLElement[] {
        if (!surface.slow) return [];
        const text = surface.slow.at(vertex) || 'no';
        return [element('tr', {}, element('th', {}, 'Slow'), element('td', { class: 'words', colspan: '2' }, text))];
    }

    private draw(): void {
        const { vertex, hover, role } = this.store.state;
        const at = hover ?? vertex;
        const surface = this.surface();
        if (at === null) {
            this.element.replaceChildren(
                element(
                    'p',
                    { class: 'hint' },
                    'Click a place, a line, a curve or a defect to see the values of its point.',
                ),
            );
            return;
        }
        const row = (name: string, value: string, unit = '') =>
            element(
                'tr',
                {},
                element('th', { title: name }, name),
                element('td', {}, value),
                element('td', { class: 'unit' }, unit),
            );
        const positions = surface.roles[Math.min(role, surface.roles.length - 1)].xyz;
        const origin = this.manifest.surfaces[0].origin_mm;
        const place = [0, 1, 2].map((k) => fixedText(positions[3 * at + k] + origin[k], 4)).join('  ');
        const line = surface.line[at];
        const rows = [
            row('Point', String(surface.point[at]), hover === null ? 'cursor' : 'pointer'),
            row('Line', line > 0 ? String(line) : '–', `of ${this.text.lineCount}`),
            element(
                'tr',
                {},
                element('th', {}, 'Text'),
                element('td', { class: 'text', colspan: '2' }, line > 0 ? this.text.line(line).slice(0, 80) : ''),
            ),
            row('Time', surface.time[at].toFixed(4), 's'),
            row('Pass', String(surface.passOf(at) || '–'), `of ${surface.info.pass_count}`),
            ...this.slowRow(surface, at),
            element(
                'tr',
                {},
                element('th', {}, 'X Y Z'),
                element('td', { class: 'words', colspan: '2' }, `${place} mm`),
            ),
            ...this.manifest.fields.map((field, k) => row(field.label, surface.textOf(k, field.unit, at), field.unit)),
        ];
        this.element.replaceChildren(element('table', {}, element('tbody', {}, ...rows)));
    }
}
