// Defects that the reader accepts or comments: kept in a file that `clsurf check --accepted` and `report --accepted` read
// (io/readers/accepted_file.h has the same names). A page cannot write files: it saves one as a download.

import type { Manifest } from './manifest';

export interface Opinion {
    accepted: boolean;
    comment: string;
}
export type Opinions = ReadonlyMap<number, Opinion>; // by the id of the defect

/** Those that the report was written with. */
export function firstOpinions(manifest: Manifest): Opinions {
    const opinions = new Map<number, Opinion>();
    for (const { id, accepted = false, comment = '' } of manifest.defects)
        if (accepted || comment) opinions.set(id, { accepted, comment });
    return opinions;
}

export function withOpinion(opinions: Opinions, id: number, opinion: Opinion): Opinions {
    const all = new Map(opinions);
    if (opinion.accepted || opinion.comment) all.set(id, opinion);
    else all.delete(id);
    return all;
}

export function opinionsText(manifest: Manifest, opinions: Opinions): string {
    const defects = manifest.defects
        .filter(({ id }) => opinions.has(id))
        .map(({ id, fingerprint, severity, text }) => ({ fingerprint, ...opinions.get(id), severity, finding: text }));
    return `${JSON.stringify({ clsurf_accepted: 1, program: manifest.program.name, defects }, null, 2)}\n`;
}

interface Entry {
    fingerprint: string;
    accepted?: boolean;
    severity?: number;
    comment?: string;
}

/** What a file says of the defects of this page, and what of it does not fit. Throws where it is no such file. */
export function readOpinions(manifest: Manifest, text: string): { opinions: Opinions; note: string } {
    const file = JSON.parse(text) as { clsurf_accepted?: number; defects?: Entry[] };
    if (file?.clsurf_accepted !== 1 || !Array.isArray(file.defects))
        throw new Error('this is not a file of accepted defects');
    const opinions = new Map<number, Opinion>();
    let [unknown, worse] = [0, 0];
    for (const entry of file.defects) {
        const defect = manifest.defects.find((d) => d.fingerprint === entry.fingerprint);
        if (!defect) {
            ++unknown;
            continue;
        }
        // One that became worse since it was accepted is looked at again.
        const grew = entry.accepted !== false && entry.severity ? defect.severity > entry.severity : false;
        worse += Number(grew);
        opinions.set(defect.id, {
            accepted: entry.accepted !== false && !grew,
            comment: typeof entry.comment === 'string' ? entry.comment : '',
        });
    }
    const notes = [`${opinions.size} of ${file.defects.length} are on this page`];
    if (unknown > 0) notes.push(`${unknown} not found: gone, or somewhere else now`);
    if (worse > 0) notes.push(`${worse} not accepted: worse than it was`);
    return { opinions, note: notes.join('; ') };
}
