// A defect on a sheet of its own: the view, what was found, and the lines of the program. Printing is the browser's.

import { factsOf } from './defect_card';
import { baseName, element } from './dom';
import type { Defect, DefectRun, Manifest } from './manifest';
import type { ProgramText } from './program_text';

// As many as the cards of the page: io/page/defect_cards.cpp.
const mostLines = 14;
const linesAtTheEnd = 3; // where not all are shown

function codeOf(text: ProgramText, run: DefectRun | undefined): HTMLElement[] {
    if (!run || run.lines[0] === 0) return [];
    const [first, last] = run.lines;
    const code = element('pre');
    const add = (n: number) =>
        code.append(element('span', { class: 'number' }, String(n).padStart(6)), ` ${text.line(n).slice(0, 100)}\n`);
    const all = last - first < mostLines;
    const shown = all ? last : first + (mostLines - linesAtTheEnd - 1) - 1;
    for (let n = first; n <= shown; ++n) add(n);
    if (!all) {
        code.append(`     … ${last - linesAtTheEnd - shown} more lines\n`);
        for (let n = last - linesAtTheEnd + 1; n <= last; ++n) add(n);
    }
    return [code];
}

function linesText(runs: DefectRun[]): string {
    return runs
        .filter((run) => run.lines[0] > 0)
        .map(({ lines: [first, last], pass }) => `${first === last ? first : `${first}–${last}`} (pass ${pass})`)
        .join(', ');
}

/** Prints the defect alone. `picture`: of the view. */
export async function printDefect(
    manifest: Manifest,
    text: ProgramText,
    defect: Defect,
    comment: string,
    picture: Blob,
): Promise<void> {
    document.querySelector('.print-card')?.remove();
    const url = URL.createObjectURL(picture);
    const image = element('img', { src: url, alt: `Defect ${defect.id}` });
    const facts = element('dl');
    for (const [name, value] of [
        ...factsOf(defect),
        ['Lines', linesText(defect.runs)],
        ['Adjacent lines', linesText(defect.neighbours)],
    ])
        if (value) facts.append(element('div', {}, element('dt', {}, name), element('dd', {}, value)));
    const card = element(
        'article',
        { class: 'print-card' },
        element('h2', {}, `Defect ${defect.id}: ${defect.severity_name}`),
        element('p', {}, `${baseName(manifest.program.name)} · ${baseName(manifest.surfaces[0].log)}`),
        element('p', {}, defect.text),
        ...(comment ? [element('p', {}, comment)] : []),
        image,
        facts,
        ...codeOf(text, defect.runs[0]),
    );
    document.body.append(card);
    document.body.classList.add('print-one');
    await image.decode();
    addEventListener(
        'afterprint',
        () => {
            document.body.classList.remove('print-one');
            card.remove();
            URL.revokeObjectURL(url);
        },
        { once: true },
    );
    print();
}
