// The table of all defects below the view: sorted by a click on a head, filtered, saved as CSV. Without JavaScript the
// rows of the file stay (io/page/page_sections.cpp): columns and their texts are the same there.

import { defectsCsv, type Column } from './defect_csv';
import { baseName, element } from './dom';
import type { Defect, DefectRun, Manifest } from './manifest';

const mostRows = 200;
const mostRuns = 4; // in a cell

function linesText(run: DefectRun): string {
    const [first, last] = run.lines;
    return first === 0 ? '–' : first === last ? String(first) : `${first}–${last}`;
}

function allLines(defect: Defect): string {
    const more = defect.runs.length > mostRuns ? ` and ${defect.runs.length - mostRuns} more` : '';
    return defect.runs.slice(0, mostRuns).map(linesText).join(', ') + more;
}

const fixed = (value: number | null | undefined, digits: number) => value?.toFixed(digits) ?? '–';
const signed = (value: number | null) => (value !== null && value >= 0 ? '+' : '') + fixed(value, 1);

function columnsOf(manifest: Manifest): Column[] {
    const columns: Column[] = [
        { head: 'Rank', value: (d) => d.id },
        { head: 'Severity', value: (d) => d.severity },
        { head: 'Finding', value: (d) => d.text },
        { head: 'Times the threshold', value: (d) => d.score, text: (d) => fixed(d.score, 1) },
        {
            head: 'Depth [µm]',
            value: (d) => d.depth_um,
            text: (d) => `${fixed(d.depth_um, 1)} ${d.shape}`,
        },
        { head: 'Formed [µm]', value: (d) => d.formed_um ?? null, text: (d) => fixed(d.formed_um, 1) },
        { head: 'Speed [%]', value: (d) => d.speed_percent, text: (d) => signed(d.speed_percent) },
        { head: 'Length [mm]', value: (d) => d.length_mm, text: (d) => fixed(d.length_mm, 1) },
        {
            head: 'X Y Z [mm]',
            value: (d) => d.position_mm[0],
            text: (d) => d.position_mm.map((c) => c.toFixed(2)).join(' '),
        },
        { head: 'Lines', value: (d) => d.runs[0]?.lines[0] ?? null, text: allLines },
    ];
    const formed = manifest.defects.some((d) => d.formed_um !== undefined);
    return columns.filter((column) => formed || column.head !== 'Formed [µm]');
}

/** What has no value comes last, whichever way is sorted. */
function compare(a: number | string | null, b: number | string | null, descending: boolean): number {
    if (a === null || b === null) return Number(a === null) - Number(b === null);
    const order = typeof a === 'string' || typeof b === 'string' ? String(a).localeCompare(String(b)) : a - b;
    return descending ? -order : order;
}

interface Filter {
    select: HTMLSelectElement;
    keeps: (defect: Defect, chosen: string) => boolean;
}

export class DefectList {
    private readonly columns: Column[];
    private readonly body: HTMLTableSectionElement;
    private readonly filters: Filter[] = [];
    private readonly count = element('span', { class: 'count', role: 'status' });
    private readonly heads: HTMLTableCellElement[] = [];
    private sorted = 0; // column
    private descending = false;

    /** `section`: of the page as it was written. */
    constructor(
        section: HTMLElement,
        private readonly manifest: Manifest,
        private readonly goToDefect: (index: number) => void,
    ) {
        this.columns = columnsOf(manifest);
        this.body = section.querySelector('tbody') as HTMLTableSectionElement;
        section.querySelector('thead')?.replaceChildren(element('tr', {}, ...this.columns.map((_, k) => this.head(k))));
        section.querySelector('.wide')?.before(this.bar());
        section.querySelector('.wide + p')?.remove(); // what the file's own rows leave out
        this.draw();
    }

    private head(k: number): HTMLElement {
        const button = element('button', { title: 'sort by this; again: the other way round' }, this.columns[k].head);
        button.addEventListener('click', () => {
            this.descending = this.sorted === k && !this.descending;
            this.sorted = k;
            this.draw();
        });
        return (this.heads[k] = element('th', { scope: 'col' }, button));
    }

    private bar(): HTMLElement {
        const { defects } = this.manifest;
        const bar = element('div', { class: 'filters', role: 'group', 'aria-label': 'filters of the defects' });
        const add = (name: string, all: string, options: [string, string][], keeps: Filter['keeps']) => {
            const select = element('select', { 'aria-label': name }, new Option(all, ''));
            for (const [value, text] of options) select.append(new Option(text, value));
            select.addEventListener('change', () => this.draw());
            this.filters.push({ select, keeps });
            bar.append(select);
        };
        const severities = new Map(defects.map((d) => [d.severity, d.severity_name]));
        add(
            'severity of defects',
            'all severities',
            [...severities].sort(([a], [b]) => b - a).map(([n, name]) => [String(n), `${n} ${name} and worse`]),
            (d, chosen) => d.severity >= Number(chosen),
        );
        const causes = [...new Set(defects.map((d) => d.cause))].sort();
        add(
            'cause of defects',
            'all causes',
            causes.map((cause) => [cause, cause.replaceAll('_', ' ')]),
            (d, chosen) => d.cause === chosen,
        );
        const passes = [...new Set(defects.flatMap((d) => d.runs.map((run) => run.pass)))].sort((a, b) => a - b);
        add(
            'pass of defects',
            'all passes',
            passes.map((pass) => [String(pass), `pass ${pass}`]),
            (d, chosen) => d.runs.some((run) => run.pass === Number(chosen)),
        );
        const save = element(
            'button',
            { 'data-action': 'save-defects', title: 'save the defects that the filters leave, in this order' },
            'CSV',
        );
        save.addEventListener('click', () => this.save());
        bar.append(save, this.count);
        return bar;
    }

    /** Those that the filters leave, in the order of the table. */
    private shown(): Defect[] {
        const { value } = this.columns[this.sorted];
        return this.manifest.defects
            .filter((d) => this.filters.every(({ select, keeps }) => !select.value || keeps(d, select.value)))
            .sort((a, b) => compare(value(a), value(b), this.descending) || a.id - b.id);
    }

    private row(defect: Defect): HTMLElement {
        const cells = this.columns.map(({ head, value, text }) => {
            if (head === 'Rank')
                return element(
                    'td',
                    {},
                    element('a', { href: `#defect-${defect.id}`, title: 'a link to this defect' }, String(defect.id)),
                );
            if (head !== 'Severity') return element('td', {}, text ? text(defect) : String(value(defect) ?? '–'));
            const badge = element('span', { class: `severity s${defect.severity}` }, String(defect.severity));
            return element('td', {}, badge, ` ${defect.severity_name}`);
        });
        const row = element('tr', { 'data-defect': String(defect.id), title: 'show this defect above' }, ...cells);
        row.addEventListener('click', (event) => {
            if (event.ctrlKey || event.metaKey) return; // the link, in a tab of its own
            event.preventDefault();
            this.goToDefect(defect.id - 1);
        });
        return row;
    }

    private draw(): void {
        const shown = this.shown();
        this.body.replaceChildren(...shown.slice(0, mostRows).map((defect) => this.row(defect)));
        this.heads.forEach((head, k) =>
            head.setAttribute('aria-sort', k !== this.sorted ? 'none' : this.descending ? 'descending' : 'ascending'),
        );
        const cut = shown.length > mostRows ? `; the table stops at ${mostRows}, CSV has all` : '';
        this.count.textContent = `${shown.length} of ${this.manifest.defects.length}${cut}`;
    }

    private save(): void {
        const text = defectsCsv(this.shown());
        const url = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
        element('a', { href: url, download: `${baseName(this.manifest.program.name)}.defects.csv` }).click();
        setTimeout(() => URL.revokeObjectURL(url), 1000);
    }
}
