// Which defects are listed, stepped through and marked: one filter for the list, the table and the view.

import { element } from './dom';
import type { Defect, Manifest } from './manifest';
import type { State, Store } from './store';

export interface DefectFilter {
    severity: number; // and worse; 0: all
    cause: string; // empty: all
    quantity: string; // that shows it best; empty: all
    pass: number; // 0: all
    state: '' | 'open' | 'accepted';
    change: '' | 'new' | 'remaining'; // against the log before
}
export const everyDefect: DefectFilter = { severity: 0, cause: '', quantity: '', pass: 0, state: '', change: '' };

export function keeps({ filter, accepted }: Readonly<State>, defect: Defect): boolean {
    const open = accepted.get(defect.id)?.accepted !== true;
    return (
        (filter.state === '' || (filter.state === 'open') === open) &&
        (filter.change === '' || filter.change === defect.change) &&
        defect.severity >= filter.severity &&
        (filter.cause === '' || defect.cause === filter.cause) &&
        (filter.quantity === '' || defect.quantity === filter.quantity) &&
        (filter.pass === 0 || defect.runs.some((run) => run.pass === filter.pass))
    );
}

/** Selects of a filter. `where` ends their names: there are two bars on a page. */
export class FilterBar {
    readonly element = element('div', { class: 'filters', role: 'group' });

    constructor(
        manifest: Manifest,
        private readonly store: Store,
        private readonly where: string,
    ) {
        const { defects } = manifest;
        this.element.setAttribute('aria-label', `filters ${where}`);
        const severities = new Map(defects.map((d) => [d.severity, d.severity_name]));
        this.add(
            'severity',
            'all severities',
            [...severities].sort(([a], [b]) => b - a).map(([n, name]) => [String(n), `${n} ${name} and worse`]),
        );
        const words = (values: string[]): [string, string][] =>
            [...new Set(values)].sort().map((value) => [value, value.replaceAll('_', ' ')]);
        this.add('cause', 'all causes', words(defects.map((d) => d.cause)));
        this.add('quantity', 'all quantities', words(defects.map((d) => d.quantity)));
        const passes = [...new Set(defects.flatMap((d) => d.runs.map((run) => run.pass)))].sort((a, b) => a - b);
        this.add(
            'pass',
            'all passes',
            passes.map((pass) => [String(pass), `pass ${pass}`]),
        );
        this.add('state', 'open and accepted', [
            ['open', 'open'],
            ['accepted', 'accepted'],
        ]);
        if (defects.some((d) => d.change))
            this.add('change', 'new and remaining', [
                ['new', 'new'],
                ['remaining', 'remaining'],
            ]);
    }

    private add(key: keyof DefectFilter, all: string, options: [string, string][]): void {
        const select = element('select', { 'aria-label': `${key} ${this.where}` }, new Option(all, ''));
        for (const [value, text] of options) select.append(new Option(text, value));
        const number = typeof everyDefect[key] === 'number';
        select.addEventListener('change', () => {
            const value = number ? Number(select.value) : select.value;
            this.store.set({ filter: { ...this.store.state.filter, [key]: value } });
        });
        this.store.on((state, changed) => {
            if (changed.has('filter')) select.value = String(state.filter[key] || '');
        });
        this.element.append(select);
    }
}
