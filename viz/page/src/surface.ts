// A log's surface as the page has it: one entry per kept point ("vertex"), with where it lies, its line,
// its time and its values.

import { readBytes, readIndices, readNumbers } from './columns';
import { classesOf, type FieldClasses } from './classes';
import { numberText } from './dom';
import type { Manifest, SurfaceInfo } from './manifest';
import { readSlowWords, type SlowWords } from './slow_words';
import { lowerBound } from './thin';

export const enum Kind {
    cut = 0,
    link = 1,
    rapid = 2,
}

export interface Role {
    name: string;
    xyz: Float32Array; // 3 per vertex [mm] from the origin
}

export class Surface {
    readonly line: Uint32Array; // 0: none

    constructor(
        readonly info: SurfaceInfo,
        readonly point: Float64Array, // rising
        private readonly runPoints: Float64Array, // where runs of points of one line begin, kept or not
        private readonly runLines: Uint32Array,
        readonly time: Float64Array, // [s]
        readonly kinds: Uint8Array, // Kind, and 4 where it goes on from the vertex before
        readonly roles: Role[], // the first is what the surface was made from
        readonly triangles: Uint32Array,
        readonly segments: Uint32Array,
        readonly fields: Float32Array[], // shown units; NaN: no value
        readonly classes: (FieldClasses | null)[], // of fields whose values are names
        readonly ramps: (Uint8Array | null)[], // per field and vertex: 1, a ramp at the end of a pass, drawn in a lighter tone
        readonly passes: Float64Array, // first and last point of each cut pass
        readonly slow: SlowWords | null, // null: the tool is slow nowhere, or it is not known
        readonly before: Float64Array | null, // the same place on the log before, in points; < 0: none
    ) {
        this.line = new Uint32Array(point.length);
        for (let i = 0, run = 0; i < point.length; ++i) {
            while (run + 1 < runPoints.length && runPoints[run + 1] <= point[i]) ++run;
            this.line[i] = runLines[run];
        }
        // Normals point up, as on a three-axis machine, so front faces must be seen from there too.
        const xyz = roles[0].xyz;
        for (let t = 0; t + 2 < triangles.length; t += 3) {
            const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
            const up = (xyz[b] - xyz[a]) * (xyz[c + 1] - xyz[a + 1]) - (xyz[b + 1] - xyz[a + 1]) * (xyz[c] - xyz[a]);
            if (up < 0) [triangles[t + 1], triangles[t + 2]] = [triangles[t + 2], triangles[t + 1]];
        }
    }

    get count(): number {
        return this.point.length;
    }
    kind(vertex: number): Kind {
        return this.kinds[vertex] & 3;
    }
    joined(vertex: number): boolean {
        return (this.kinds[vertex] & 4) !== 0;
    }

    /** The vertex nearest to a value of a rising column. */
    private nearest(column: Float64Array, value: number): number {
        let low = 0;
        let high = column.length - 1;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (column[middle] < value) low = middle + 1;
            else high = middle;
        }
        return low > 0 && value - column[low - 1] <= column[low] - value ? low - 1 : low;
    }
    vertexOfPoint(point: number): number {
        return this.nearest(this.point, point);
    }
    /** The first vertex at or after a time; the last one where there is none. */
    vertexFrom(time: number): number {
        return Math.min(this.count - 1, lowerBound(this.time, time));
    }
    vertexAtTime(time: number): number {
        return this.nearest(this.time, time);
    }
    /** Vertices of points [first, last], as a half-open range. */
    range(first: number, last: number): [number, number] {
        let begin = this.nearest(this.point, first);
        while (begin < this.count && this.point[begin] < first) ++begin;
        let end = begin;
        while (end < this.count && this.point[end] <= last) ++end;
        return [begin, end];
    }

    private runs: Map<number, number[]> | null = null; // of a line, by number
    /** First and last point of every run of a line. */
    pointsOfLine(line: number): [number, number][] {
        if (!this.runs) {
            this.runs = new Map();
            this.runLines.forEach((of, run) => {
                const known = this.runs?.get(of);
                if (known) known.push(run);
                else this.runs?.set(of, [run]);
            });
        }
        const end = (run: number) =>
            (run + 1 < this.runPoints.length ? this.runPoints[run + 1] : this.info.records) - 1;
        return (this.runs.get(line) ?? []).map((run) => [this.runPoints[run], end(run)]);
    }
    /** Vertices of runs of a line, as half-open ranges; where none of its points is kept, the nearest one. */
    runsOfLine(line: number, most = Infinity): [number, number][] {
        const points = this.pointsOfLine(line);
        return points.slice(0, most).map(([first, last]) => {
            const [begin, end] = this.range(first, last);
            const nearest = this.vertexOfPoint(first);
            return end > begin ? [begin, end] : [nearest, nearest + 1];
        });
    }

    /** The two vertices of the log before that lie about the place of a vertex, and how far from the first to the second. */
    besideBefore(vertex: number, before: Surface): { vertices: [number, number]; along: number } | null {
        const place = this.before?.[vertex] ?? -1;
        if (place < 0) return null;
        const next = Math.min(before.count - 1, lowerBound(before.point, place));
        const last = Math.max(0, next - 1);
        const step = before.point[next] - before.point[last];
        const along = step > 0 && before.joined(next) ? (place - before.point[last]) / step : 1;
        return { vertices: [last, next], along: Math.min(1, Math.max(0, along)) };
    }

    /** The value of a field at a vertex: a number, or the name of its class where it has no unit. */
    textOf(field: number, unit: string, vertex: number): string {
        const known = unit === '' ? this.classes[field]?.of(vertex) : null;
        return known && !known.others ? known.name : numberText(this.fields[field][vertex]);
    }

    /** Number of the cut pass of a vertex, from 1; 0: none. */
    passOf(vertex: number): number {
        const point = this.point[vertex];
        let low = 0;
        let high = this.passes.length / 2;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (this.passes[2 * middle + 1] < point) low = middle + 1;
            else high = middle;
        }
        return 2 * low < this.passes.length && this.passes[2 * low] <= point ? low + 1 : 0;
    }
}

/** A field of the surface minus that of the log before, at the same places; NaN where that was not. */
export function differenceOf(after: Surface, before: Surface, field: number): Float32Array {
    const values = after.fields[field].slice();
    const old = before.fields[field];
    for (let i = 0; i < values.length; ++i) {
        const beside = after.besideBefore(i, before);
        if (!beside) {
            values[i] = NaN;
            continue;
        }
        const [last, next] = beside.vertices;
        values[i] -= old[last] + beside.along * (old[next] - old[last]);
    }
    return values;
}

/** Positions from a common origin, so that two logs lie in one space. */
async function readPositions(info: SurfaceInfo, origin: readonly number[]): Promise<Float32Array> {
    const axes = await Promise.all(
        [info.columns.x, info.columns.y, info.columns.z].map((c) => readNumbers(c, info.position_quantum_mm)),
    );
    const xyz = new Float32Array(3 * axes[0].length);
    for (let k = 0; k < 3; ++k) {
        const shift = info.origin_mm[k] - origin[k];
        for (let i = 0; i < axes[k].length; ++i) xyz[3 * i + k] = axes[k][i] + shift;
    }
    return xyz;
}

async function readRoles(info: SurfaceInfo, origin: readonly number[]): Promise<Role[]> {
    const own = await readPositions(info, origin);
    const roles: Role[] = [{ name: info.role, xyz: own }];
    for (const role of info.roles) {
        const xyz = own.slice();
        for (const [k, column] of [role.x, role.y, role.z].entries()) {
            const steps = await readNumbers(column, info.position_quantum_mm);
            for (let i = 0; i < steps.length; ++i) xyz[3 * i + k] += steps[i];
        }
        roles.push({ name: role.name, xyz });
    }
    return roles;
}

async function readField(field: SurfaceInfo['fields'][number]): Promise<Float32Array> {
    const values = Float32Array.from(await readNumbers(field.values, field.quantum));
    if (field.missing) {
        const missing = await readBytes(field.missing);
        for (let i = 0; i < values.length; ++i) if (missing[i]) values[i] = NaN;
    }
    return values;
}

/** 1 at the vertices whose points lie in one of the ranges, which rise: first and last point of each. */
function inRanges(point: Float64Array, ranges: Float64Array): Uint8Array {
    const inside = new Uint8Array(point.length);
    for (let r = 0, i = 0; r < ranges.length; r += 2) {
        while (i < point.length && point[i] < ranges[r]) ++i;
        while (i < point.length && point[i] <= ranges[r + 1]) inside[i++] = 1;
    }
    return inside;
}

async function readRamps(info: SurfaceInfo, point: Float64Array): Promise<(Uint8Array | null)[]> {
    const all: (Uint8Array | null)[] = [];
    for (const { ramps } of info.fields) all.push(ramps ? inRanges(point, await readNumbers(ramps)) : null);
    return all;
}

export async function readSurface(manifest: Manifest, index: number): Promise<Surface> {
    const info = manifest.surfaces[index];
    const { columns } = info;
    const point = await readNumbers(columns.point);
    const time = columns.time
        ? await readNumbers(columns.time, info.time_quantum_s)
        : point.map((n) => n * info.period_s);
    const fields: Float32Array[] = [];
    for (const field of info.fields) fields.push(await readField(field));
    return new Surface(
        info,
        point,
        await readNumbers(columns.run_points),
        await readIndices(columns.run_lines),
        time,
        await readBytes(columns.kind),
        await readRoles(info, manifest.surfaces[0].origin_mm),
        await readIndices(columns.triangles),
        await readIndices(columns.segments),
        fields,
        info.fields.map(({ classes, quantum }, k) => (classes ? classesOf(classes, fields[k], quantum) : null)),
        await readRamps(info, point),
        await readNumbers(columns.passes),
        info.slow ? await readSlowWords(info.slow) : null,
        columns.before ? (await readNumbers(columns.before)).map((n) => n / 16 - 1) : null,
    );
}
