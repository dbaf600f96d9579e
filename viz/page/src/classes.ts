// Fields whose values are names, as viz/field_classes.cpp has them: each class has a colour of its own, and nothing lies
// between two of them.

import { ColourMap, type ColourScale, type Rgb } from './colour';
import type { Mesh } from './gl_view';
import type { ClassInfo } from './manifest';
import { Kind, type Surface } from './surface';

const otherColours: Rgb[] = [
    [200, 200, 200],
    [176, 176, 176],
];
const equalColour: Rgb = [226, 226, 226];
const differentColour: Rgb = [204, 102, 119];
const none = -1; // no value

export interface ShownClass {
    name: string;
    rgb: Rgb;
    share: number; // of the cutting points, 0 … 1
    others?: boolean; // all that have no colour of their own
}

export class FieldClasses {
    readonly scale: ColourScale;
    readonly starts: number[] = []; // vertices at which another class begins than that of the vertex before
    private readonly occurs: Set<number>;

    /** `at`: which class each vertex is of. */
    constructor(
        private readonly classes: ShownClass[],
        readonly at: Int16Array,
    ) {
        this.scale = scaleOf(classes.map(({ rgb }) => rgb));
        this.occurs = new Set(at);
        at.forEach((k, i) => {
            if (i === 0 || k !== at[i - 1]) this.starts.push(i);
        });
    }

    /** Those that occur, the largest share first. */
    get shown(): ShownClass[] {
        return this.classes.filter(({ name }, k) => name !== '' && this.occurs.has(k));
    }
    /** Of a vertex; null: it has no value. */
    of(vertex: number): ShownClass | null {
        return this.classes[this.at[vertex]] ?? null;
    }
    /** Places on the scale, one per vertex. */
    get places(): Float32Array {
        return Float32Array.from(this.at, (k) => (k === none ? NaN : k + 0.5));
    }
}

/** Steps in the colours of the classes, one wide. */
function scaleOf(colours: Rgb[]): ColourScale {
    // Each colour twice: a map mixes its colours, but not within a step.
    const rgb = btoa(String.fromCharCode(...colours.flatMap((c) => [...c, ...c])));
    const ends = { below: colours[0], above: colours[colours.length - 1] };
    const map = new ColourMap({ name: 'classes', summary: '', centred: false, rgb, ...ends });
    return { map, low: 0, high: colours.length, bins: colours.length, slack: 0 };
}

/** `values`: one per vertex, multiples of `quantum`. Those of no class of the list have two greys in turn. */
export function classesOf(list: ClassInfo[], values: Float32Array, quantum: number): FieldClasses {
    const indices = new Map(list.map(({ step }, k) => [step, k]));
    const steps = Float64Array.from(values, (v) => (v === v ? Math.round(v / quantum) : NaN));
    const others = [...new Set(steps)].filter((step) => step === step && !indices.has(step)).sort((a, b) => a - b);
    others.forEach((step, rank) => indices.set(step, list.length + (rank % otherColours.length)));
    const share = Math.max(0, 1 - list.reduce((sum, c) => sum + c.share, 0));
    const name = others.length === 1 ? '1 other' : `${others.length} others`;
    const greys = otherColours.slice(0, others.length).map((rgb, k) => ({
        name: k === 0 ? name : '',
        rgb,
        share,
        others: true,
    }));
    return new FieldClasses(
        [...list, ...greys],
        Int16Array.from(steps, (step) => indices.get(step) ?? none),
    );
}

/** Where the class of a surface is not that of the log before at the same place. */
export function differenceOfClasses(after: Surface, before: Surface, field: number): FieldClasses {
    const [own, old] = [after.fields[field], before.fields[field]];
    const at = Int16Array.from(own, (value, i) => {
        const beside = after.besideBefore(i, before);
        if (!beside || !(value === value)) return none;
        const others = beside.vertices.map((v) => old[v]).filter((v) => v === v);
        if (others.length === 0) return none;
        // Between two points of the log before both count: where a class ends is known to a step only.
        return others.includes(value) ? 0 : 1;
    });
    const weights = [0, 0];
    at.forEach((k, i) => {
        if (k === none || after.kind(i) !== Kind.cut) return;
        weights[k] += after.joined(i) ? after.point[i] - after.point[i - 1] : 1; // points that the page left out are like it
    });
    const share = (k: number) => weights[k] / (weights[0] + weights[1] || 1);
    return new FieldClasses(
        [
            { name: 'as before', rgb: equalColour, share: share(0) },
            { name: 'different', rgb: differentColour, share: share(1) },
        ],
        at,
    );
}

/** "41 %", "0.3 %", "< 0.1 %". */
export function shareText(share: number): string {
    const percent = 100 * share;
    if (percent === 0) return '0 %';
    if (percent < 0.1) return '< 0.1 %';
    return `${percent.toFixed(percent < 10 ? 1 : 0)} %`;
}

/** Appends vertices to those of a mesh. */
class Divider {
    private readonly xyz: number[] = [];
    private readonly normals: number[] = [];
    private readonly sources: number[] = [];
    private readonly first: number;

    constructor(
        private readonly mesh: Mesh,
        private readonly at: Int16Array,
    ) {
        this.first = mesh.xyz.length / 3;
    }

    private same(...vertices: number[]): boolean {
        return vertices.every((v) => this.at[v] === this.at[vertices[0]]);
    }

    /** A vertex in the middle of some, of the class of `corner`. */
    private meanOf(vertices: readonly number[], corner: number): number {
        const add = (column: Float32Array, to: number[]) => {
            for (let k = 0; k < 3; ++k)
                to.push(vertices.reduce((sum, v) => sum + column[3 * v + k], 0) / vertices.length);
        };
        add(this.mesh.xyz, this.xyz);
        if (this.mesh.normals) add(this.mesh.normals, this.normals);
        this.sources.push(corner);
        return this.first + this.sources.length - 1;
    }

    private triangles(): Uint32Array {
        const { triangles } = this.mesh;
        const out: number[] = [];
        for (let t = 0; t < triangles.length; t += 3) {
            const v = [triangles[t], triangles[t + 1], triangles[t + 2]];
            if (this.same(...v)) {
                out.push(...v);
                continue;
            }
            v.forEach((corner, k) => {
                const toNext = this.meanOf([corner, v[(k + 1) % 3]], corner);
                const centre = this.meanOf(v, corner);
                const toLast = this.meanOf([corner, v[(k + 2) % 3]], corner);
                out.push(corner, toNext, centre, corner, centre, toLast);
            });
        }
        return Uint32Array.from(out);
    }

    private segments(): Uint32Array {
        const { segments } = this.mesh;
        const out: number[] = [];
        for (let s = 0; s < segments.length; s += 2) {
            const ends = [segments[s], segments[s + 1]];
            if (this.same(...ends)) out.push(...ends);
            else for (const end of ends) out.push(end, this.meanOf(ends, end));
        }
        return Uint32Array.from(out);
    }

    divided(): DividedMesh {
        const joined = (column: Float32Array, more: number[]) => {
            const all = new Float32Array(column.length + more.length);
            all.set(column);
            all.set(more, column.length);
            return all;
        };
        const { mesh } = this;
        const [triangles, segments] = [this.triangles(), this.segments()];
        return {
            mesh: {
                xyz: joined(mesh.xyz, this.xyz),
                normals: mesh.normals && joined(mesh.normals, this.normals),
                triangles,
                segments,
                points: mesh.points,
            },
            sources: Uint32Array.from(this.sources),
        };
    }
}

export interface DividedMesh {
    mesh: Mesh;
    sources: Uint32Array; // the vertices whose class those have that were appended
}

/** Cells whose corners are of different classes, divided so that each part is of the class of its nearest corner. */
export function divideByClass(mesh: Mesh, classes: FieldClasses): DividedMesh {
    return new Divider(mesh, classes.at).divided();
}
