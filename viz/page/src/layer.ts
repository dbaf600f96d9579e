// The surface of one log on a canvas of its own.

import { shownCells, waySegments } from './cells';
import { divideByClass, type FieldClasses } from './classes';
import type { ColourScale } from './colour';
import { element } from './dom';
import { GlView, normalsOf, type Mesh } from './gl_view';
import type { HeightMap } from './height_map';
import type { Picker } from './picker';
import type { Style } from './store';
import type { Surface } from './surface';

/** What is drawn of a surface. */
export interface Drawn {
    role: number; // of the positions
    style: Style;
    shows: ((vertex: number) => boolean) | null; // null: all
    classes: FieldClasses | null; // null: the values are numbers
}

export class Layer {
    readonly box = element('div', { class: 'layer' });
    readonly view: GlView;
    picker: Picker | null = null;
    private readonly normals = new Map<number, Float32Array>(); // by role
    private classes: FieldClasses | null = null; // that the cells are divided by
    private drawn: Uint32Array[] = []; // corners of the cells that are drawn
    private sources: Uint32Array = new Uint32Array(0); // vertices whose class those have that divided cells were given

    constructor(
        container: HTMLElement,
        readonly surface: Surface,
    ) {
        container.append(this.box);
        this.view = new GlView(this.box);
    }

    xyzOf(role: number): Float32Array {
        const { roles } = this.surface;
        return roles[Math.min(role, roles.length - 1)].xyz;
    }

    isDividedBy(classes: FieldClasses | null): boolean {
        return this.classes === classes;
    }

    showHeightMap({ xyz, triangles }: HeightMap): void {
        this.picker = null;
        this.classes = null;
        this.drawn = [triangles];
        this.view.setMesh(
            {
                xyz,
                triangles,
                normals: normalsOf(xyz, triangles),
                segments: new Uint32Array(0),
                points: Uint32Array.from({ length: xyz.length / 3 }, (_, i) => i),
            },
            'surface',
        );
    }

    showSurface({ role, style, shows, classes }: Drawn): void {
        const { surface } = this;
        this.picker = null;
        this.classes = classes;
        this.sources = new Uint32Array(0);
        const xyz = this.xyzOf(role);
        let normals = this.normals.get(role) ?? null;
        if (!normals && style === 'surface') this.normals.set(role, (normals = normalsOf(xyz, surface.triangles)));
        const part = (corners: Uint32Array, size: number) => (shows ? shownCells(corners, size, shows) : corners);
        let mesh: Mesh = {
            xyz,
            normals,
            triangles: part(surface.triangles, 3),
            segments: part(style === 'lines' ? waySegments(surface) : surface.segments, 2),
            points: part(
                Uint32Array.from({ length: surface.count }, (_, i) => i),
                1,
            ),
        };
        if (classes) ({ mesh, sources: this.sources } = divideByClass(mesh, classes));
        this.drawn = style === 'points' ? [mesh.points] : [mesh.triangles, mesh.segments];
        this.view.setMesh(mesh, style);
    }

    /** Whether something that is drawn has no value, and so is hatched. */
    lacksValues(values: Float32Array): boolean {
        const { count } = this.surface;
        const source = (vertex: number) => (this.classes && vertex >= count ? this.sources[vertex - count] : vertex);
        return this.drawn.some((cells) => cells.some((vertex) => Number.isNaN(values[source(vertex)])));
    }

    /** `values`: one per vertex of the surface, or of the height map; not used where there are classes. `pale`: 1, a lighter tone. */
    setValues(values: Float32Array, scale: ColourScale, pale: Uint8Array | null): void {
        if (!this.classes) return this.view.setValues(values, scale, pale);
        const { places } = this.classes;
        const all = new Float32Array(places.length + this.sources.length);
        all.set(places);
        this.sources.forEach((source, k) => (all[places.length + k] = places[source]));
        this.view.setValues(all, scale, null);
    }
}
