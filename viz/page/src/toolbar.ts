// The bar of buttons: actions, field, colour map, locate.

import type { Action } from './actions';
import { element } from './dom';
import type { Manifest } from './manifest';
import { showFormed, type Store } from './store';

const formedChoice = 'formed'; // in the list of fields

export interface Locator {
    kind: HTMLSelectElement;
    input: HTMLInputElement;
}

export class Toolbar {
    readonly element = element('div', { class: 'toolbar', role: 'toolbar', 'aria-label': 'tools' });
    readonly locator: Locator;

    constructor(
        manifest: Manifest,
        store: Store,
        actions: Action[],
        locate: (kind: string, value: number) => string | null,
    ) {
        const field = element('select', { title: 'coloured field', 'aria-label': 'field' });
        manifest.fields.forEach((f, k) =>
            field.append(new Option(f.unit ? `${f.label} [${f.unit}]` : f.label, String(k))),
        );
        if (manifest.relief) field.append(new Option('As-machined surface over its form [µm]', formedChoice));
        field.addEventListener('change', () => {
            if (field.value === formedChoice) store.set(showFormed(store.state));
            else store.set({ field: Number(field.value), formed: false });
        });
        const map = element('select', { title: 'colour map (key K)', 'aria-label': 'colour map' });
        for (const m of manifest.colour_maps) {
            const option = new Option(m.name, m.name);
            option.title = m.summary;
            map.append(option);
        }
        map.addEventListener('change', () => store.set({ map: map.value }));
        const bins = element('select', { title: 'continuous colours or steps', 'aria-label': 'colour steps' });
        for (const n of [0, 6, 8, 10, 12, 16])
            bins.append(new Option(n === 0 ? 'continuous' : `${n} steps`, String(n)));
        bins.addEventListener('change', () => store.set({ bins: Number(bins.value) }));
        this.element.append(element('span', { class: 'set' }, field, map, bins));

        const groups = new Map<string, HTMLElement>();
        for (const action of actions) {
            if (!action.text) continue;
            let group = groups.get(action.group);
            if (!group) {
                groups.set(action.group, (group = element('span', { class: 'set' })));
                this.element.append(group);
            }
            const button = element('button', { 'data-action': action.name }, action.text);
            button.addEventListener('click', () => action.run());
            group.append(button);
        }
        this.locator = this.addLocator(locate);
        const setMaps = () => {
            map.disabled = bins.disabled = manifest.fields[store.state.field].classes && !store.state.formed;
        };
        setMaps();
        store.on((state) => {
            setMaps();
            field.value = state.formed ? formedChoice : String(state.field);
            map.value = state.map;
            bins.value = String(state.bins);
            this.update(actions, state.keys);
        });
        this.update(actions, store.state.keys);
    }

    private addLocator(locate: (kind: string, value: number) => string | null): Locator {
        const kind = element(
            'select',
            { 'aria-label': 'target' },
            new Option('line', 'line'),
            new Option('point', 'point'),
            new Option('time [s]', 'time'),
        );
        const input = element('input', {
            type: 'text',
            inputmode: 'decimal',
            size: '8',
            placeholder: 'go to …',
            title: 'a number, then Enter (key G)',
            'aria-label': 'go to',
        });
        const go = () => {
            const value = Number(input.value.replace(',', '.'));
            const problem =
                input.value.trim() === '' || !Number.isFinite(value) ? 'enter a number' : locate(kind.value, value);
            input.setCustomValidity(problem ?? '');
            if (problem) input.reportValidity();
        };
        input.addEventListener('keydown', (event) => event.key === 'Enter' && go());
        input.addEventListener('input', () => input.setCustomValidity(''));
        this.element.append(element('span', { class: 'set' }, kind, input));
        return { kind, input };
    }

    private update(actions: Action[], keys: boolean): void {
        for (const action of actions) {
            const button = this.element.querySelector<HTMLElement>(`[data-action="${action.name}"]`);
            if (!button) continue;
            button.title = keys ? `${action.title} (key ${action.key.toUpperCase()})` : action.title;
            if (action.pressed) button.setAttribute('aria-pressed', String(action.pressed()));
        }
    }
}
