// What is marked on the surface: defects, and the line, pass and point that are chosen.

import { styleValue } from './dom';
import { keeps } from './filters';
import type { Defect, Manifest } from './manifest';
import type { Polyline, Ring, Tag } from './overlay';
import type { State } from './store';
import type { Surface } from './surface';

const mostTags = 40; // numbers of defects in the picture
const fewRuns = 8; // of a defect, that hide nothing
const mostRuns = 200; // of a line
const mostCorners = 5000; // of a run

export interface Marks {
    tags: Tag[];
    polylines: Polyline[];
    rings: Ring[];
}

/** `judged`: the defects are those of this surface. */
export function marksOf(
    manifest: Manifest,
    state: Readonly<State>,
    surface: Surface,
    xyz: Float32Array,
    judged: boolean,
): Marks {
    const accent = styleValue('--accent');
    const marks: Marks = { tags: [], polylines: [], rings: [] };
    if (judged) addDefects(manifest, state, marks);
    if (state.shown !== 'after') addGone(manifest, marks);

    const addRun = ([begin, end]: [number, number], colour: string, width: number, between = 0) => {
        const corners: number[] = [];
        const step = Math.max(1, Math.floor((end - begin) / mostCorners));
        for (let i = begin; i < end; i += step) corners.push(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        if (corners.length === 3) corners.push(...corners);
        marks.polylines.push({ xyz: corners, colour, width, between });
    };
    const beside = styleValue('--second');
    if (state.pass > 0)
        addRun(surface.range(surface.passes[2 * state.pass - 2], surface.passes[2 * state.pass - 1]), beside, 2);
    if (state.defect !== null && judged) {
        const defect = manifest.defects[state.defect];
        const between = defect.runs.length > fewRuns ? surface.info.step_over_mm : 0;
        for (const run of defect.neighbours) addRun(surface.range(...run.points), beside, 2, between);
        for (const run of defect.runs) addRun(surface.range(...run.points), accent, 2, between);
    }
    const runs = state.line > 0 ? surface.runsOfLine(state.line, mostRuns) : [];
    for (const run of runs) addRun(run, accent, 4);

    const addRing = (vertex: number, label: string, small: boolean) =>
        marks.rings.push({
            at: [xyz[3 * vertex], xyz[3 * vertex + 1], xyz[3 * vertex + 2]],
            colour: accent,
            label,
            small,
        });
    if (runs.length > 0 && runs[0][0] !== state.vertex) addRing(runs[0][0], '', true);
    if (state.vertex !== null && !state.playing)
        addRing(state.vertex, `point ${surface.point[state.vertex]}, line ${surface.line[state.vertex]}`, false);
    return marks;
}

/** Defects of the log before that are gone. */
function addGone(manifest: Manifest, marks: Marks): void {
    const origin = manifest.surfaces[0].origin_mm;
    for (const { id, severity, tip_mm } of manifest.gone.slice(0, mostTags))
        marks.tags.push({
            at: tip_mm.map((c, k) => c - origin[k]),
            text: `gone ${id}`,
            severity,
            chosen: false,
            defect: null,
        });
}

/** Whether one of its passes is. */
function isDrawn(defect: Defect, passes: readonly [number, number] | null): boolean {
    return passes === null || defect.runs.some(({ pass }) => pass >= passes[0] && pass <= passes[1]);
}

function addDefects(manifest: Manifest, state: Readonly<State>, marks: Marks): void {
    const origin = manifest.surfaces[0].origin_mm;
    manifest.defects.forEach((defect, k) => {
        const chosen = state.defect === k;
        if (!chosen && !(keeps(state, defect) && isDrawn(defect, state.passes))) return;
        // The surface that is drawn is that of the tool tips, unless it is what the tool formed.
        const outlines = (state.formed && defect.contact_outlines) || defect.outlines;
        const place = state.formed ? defect.position_mm : defect.tip_mm;
        if (marks.tags.length < mostTags || chosen)
            marks.tags.push({
                at: place.map((c, i) => c - origin[i]),
                text: String(defect.id),
                severity: manifest.judged && !state.accepted.get(defect.id)?.accepted ? defect.severity : 0,
                chosen,
                defect: k,
            });
        if (!chosen && !state.defects) return;
        for (const corners of outlines) {
            marks.polylines.push({
                xyz: corners.map((c, i) => c - origin[i % 3]),
                colour: styleValue(chosen ? '--accent' : '--ink'),
                width: chosen ? 2.5 : 1.3,
            });
        }
    });
}
