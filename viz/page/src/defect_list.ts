// The table of all defects below the view: sorted by a click on a head, filtered, saved as CSV. Without JavaScript the
// rows of the file stay (io/page/page_sections.cpp): columns and their texts are the same there.

import { fixedText, signedText } from './decimal_text';
import { defectsCsv, type Column } from './defect_csv';
import { opinionsText, readOpinions } from './accepted';
import { baseName, element, saveFile } from './dom';
import { FilterBar, keeps } from './filters';
import type { Defect, DefectRun, Manifest } from './manifest';
import type { Store } from './store';

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

const fixed = (value: number | null | undefined, digits: number) =>
    value === null || value === undefined ? '–' : fixedText(value, digits);
const signed = (value: number | null) => (value === null ? '–' : signedText(value, 1));

function columnsOf(manifest: Manifest): Column[] {
    const columns: Column[] = [
        { head: 'Rank', value: (d) => d.id },
        { head: 'Severity', value: (d) => d.severity },
        { head: 'Finding', value: (d) => d.text },
        { head: 'Times the threshold', value: (d) => d.score, text: (d) => fixed(d.score, 1) },
        {
            head: 'Depth [µm]',
            value: (d) => d.depth_um,
            text: (d) => fixed(d.depth_um, 1) + (d.shape === 'none' ? '' : ` ${d.shape}`),
        },
        { head: 'Formed [µm]', value: (d) => d.formed_um ?? null, text: (d) => fixed(d.formed_um, 1) },
        { head: 'Speed [%]', value: (d) => d.speed_percent, text: (d) => signed(d.speed_percent) },
        { head: 'Length [mm]', value: (d) => d.length_mm, text: (d) => fixed(d.length_mm, 1) },
        {
            head: 'X Y Z [mm]',
            value: (d) => d.position_mm[0],
            text: (d) => d.position_mm.map((c) => fixedText(c, 2)).join(' '),
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

export class DefectList {
    private readonly columns: Column[];
    private readonly body: HTMLTableSectionElement;
    private readonly count = element('span', { class: 'count', role: 'status' });
    private readonly note = element('span', { class: 'note-of-file', role: 'status' });
    private readonly heads: HTMLTableCellElement[] = [];
    private sorted = 0; // column
    private descending = false;

    /** `section`: of the page as it was written. */
    constructor(
        section: HTMLElement,
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly goToDefect: (index: number) => void,
    ) {
        this.columns = columnsOf(manifest);
        this.body = section.querySelector('tbody') as HTMLTableSectionElement;
        section.querySelector('thead')?.replaceChildren(element('tr', {}, ...this.columns.map((_, k) => this.head(k))));
        section.querySelector('.wide')?.before(this.bar());
        section.querySelector('.wide + p')?.remove(); // what the file's own rows leave out
        store.on((_, changed) => {
            if (changed.has('filter') || changed.has('accepted')) this.draw();
        });
        this.draw();
    }

    private head(k: number): HTMLElement {
        const button = element(
            'button',
            { title: 'sort by this column; click again to reverse' },
            this.columns[k].head,
        );
        button.addEventListener('click', () => {
            this.descending = this.sorted === k && !this.descending;
            this.sorted = k;
            this.draw();
        });
        return (this.heads[k] = element('th', { scope: 'col' }, button));
    }

    private bar(): HTMLElement {
        const bar = new FilterBar(this.manifest, this.store, 'of defects').element;
        const save = element(
            'button',
            { 'data-action': 'save-defects', title: 'save the defects that the filters leave, in this order' },
            'CSV',
        );
        save.addEventListener('click', () => this.save());
        bar.append(save, ...this.opinionButtons(), this.count, this.note);
        return bar;
    }

    /** The file of accepted defects, out and in. */
    private opinionButtons(): HTMLElement[] {
        const save = element(
            'button',
            { 'data-action': 'save-accepted', title: 'save accepted defects and comments for clsurf check --accepted' },
            'Save accepted',
        );
        save.addEventListener('click', () => {
            const text = opinionsText(this.manifest, this.store.state.accepted);
            const name = `${baseName(this.manifest.program.name)}.accepted.json`;
            saveFile(name, new Blob([text], { type: 'application/json' }));
        });
        const file = element('input', {
            type: 'file',
            accept: '.json',
            hidden: '',
            'aria-label': 'file of accepted defects',
        });
        file.addEventListener('change', async () => {
            const chosen = file.files?.[0];
            file.value = '';
            if (!chosen) return;
            try {
                const { opinions, note } = readOpinions(this.manifest, await chosen.text());
                this.store.set({ accepted: opinions });
                this.note.textContent = note;
            } catch (error) {
                this.note.textContent = `${chosen.name}: ${error instanceof Error ? error.message : String(error)}`;
            }
        });
        const load = element(
            'button',
            { 'data-action': 'load-accepted', title: 'load accepted defects and comments from a file' },
            'Load accepted',
        );
        load.addEventListener('click', () => file.click());
        return [save, load, file];
    }

    /** Those that the filters leave, in the order of the table. */
    private shown(): Defect[] {
        const { value } = this.columns[this.sorted];
        return this.manifest.defects
            .filter((d) => keeps(this.store.state, d))
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
            const opinion = this.store.state.accepted.get(defect.id);
            if (head === 'Finding' && opinion) {
                const words = [opinion.accepted ? 'accepted' : '', opinion.comment].filter(Boolean).join(': ');
                return element('td', {}, defect.text, element('br'), element('small', {}, words));
            }
            if (head !== 'Severity') return element('td', {}, text ? text(defect) : String(value(defect) ?? '–'));
            const badge = element('span', { class: `severity s${defect.severity}` }, String(defect.severity));
            return element('td', {}, badge, ` ${defect.severity_name}`);
        });
        const row = element('tr', { 'data-defect': String(defect.id), title: 'show this defect above' }, ...cells);
        row.classList.toggle('accepted', this.store.state.accepted.get(defect.id)?.accepted === true);
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
        const text = defectsCsv(this.shown(), this.store.state.accepted);
        saveFile(`${baseName(this.manifest.program.name)}.defects.csv`, new Blob([text], { type: 'text/csv' }));
    }
}
