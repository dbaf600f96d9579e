// What is loaded: program, positions, formed surface, passes, defects.

import { baseName, element } from './dom';
import type { Manifest } from './manifest';
import type { State, Store } from './store';
import type { Surface } from './surface';

const mostPasses = 1000;
/** Below its neighbours, above them, or both in turn. */
const shapeSigns: Record<string, string> = { pit: '▾ ', bulge: '▴ ', alternating: '± ' };

export class TreePane {
    readonly element = element('nav', { class: 'tree', 'aria-label': 'contents' });
    private readonly passes = element('details', { class: 'passes' });

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly surface: () => Surface,
        private readonly goToDefect: (index: number) => void,
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
            this.defects(),
            this.passes,
        );
        this.fillPasses();
        this.update(store.state);
        store.on((state, changed) => {
            if (changed.has('shown')) this.fillPasses();
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
                    this.store.set({ formed: true }),
                ),
            );
        return element('div', { class: 'group' }, element('h3', {}, 'Surface'), list);
    }

    private defects(): HTMLElement {
        const { defects } = this.manifest;
        const list = element('div', { class: 'list' });
        defects.slice(0, 500).forEach((defect, k) => {
            const depth =
                defect.depth_um === null ? '' : `${shapeSigns[defect.shape] ?? ''}${defect.depth_um.toFixed(1)} µm`;
            const button = element(
                'button',
                { class: 'item', 'data-choice': `defect-${k}`, title: defect.text },
                element(
                    'span',
                    { class: `severity s${defect.severity}`, title: `severity ${defect.severity} of 4` },
                    String(defect.id),
                ),
                element('span', {}, defect.cause.replace('_', ' ')),
                element('small', {}, depth),
            );
            button.addEventListener('click', () => this.goToDefect(k));
            list.append(button);
        });
        return element(
            'details',
            { open: '' },
            element('summary', {}, `Defects (${defects.length})`),
            defects.length > 0 ? list : element('p', { class: 'hint' }, 'none'),
        );
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
        this.passes.replaceChildren(element('summary', {}, `Passes (${count.toLocaleString('en')})`), list);
    }

    private update(state: Readonly<State>): void {
        const chosen = new Set([
            state.formed ? 'formed' : `role-${state.role}`,
            `defect-${state.defect}`,
            `pass-${state.pass}`,
        ]);
        for (const button of this.element.querySelectorAll<HTMLElement>('[data-choice]')) {
            button.setAttribute('aria-pressed', String(chosen.has(button.dataset.choice ?? '')));
        }
    }
}
