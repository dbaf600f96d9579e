// The values that the view colours: a field, what the tool formed, or the difference of two logs.

import { differenceOfClasses, type FieldClasses } from './classes';
import type { HeightMap } from './height_map';
import type { Manifest } from './manifest';
import type { Store } from './store';
import { differenceOf, Kind, type Surface } from './surface';

export interface Ends {
    low: number; // of the colours
    high: number;
    lowest: number; // of the values
    highest: number;
}

export class ShownValues {
    private readonly differences = new Map<number, Float32Array>(); // by field
    private readonly classDifferences = new Map<number, FieldClasses>(); // by field
    private readonly differenceEnds = new Map<number, Ends>();

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly surfaces: Surface[],
        private readonly heightMap: HeightMap | null,
    ) {}

    /** Of a log's surface, one per vertex of what is shown of it. */
    of(surface: Surface): Float32Array {
        const { formed, field, shown } = this.store.state;
        if (surface === this.surfaces[0]) {
            if (formed && this.heightMap) return this.heightMap.deviation;
            if (shown === 'difference' && !this.manifest.fields[field].classes) return this.difference(field);
        }
        return surface.fields[field];
    }

    /** 1 at the vertices of a log's surface that have a lighter tone; null: none. */
    pale(surface: Surface): Uint8Array | null {
        const { formed, field, shown } = this.store.state;
        if (surface === this.surfaces[0] && ((formed && this.heightMap) || shown === 'difference')) return null;
        return surface.ramps[field];
    }

    /** Where what is coloured are names; null: numbers. */
    classes(surface: Surface): FieldClasses | null {
        const { formed, field, shown } = this.store.state;
        if (!this.manifest.fields[field].classes || (formed && this.heightMap)) return null;
        if (shown !== 'difference' || surface !== this.surfaces[0]) return surface.classes[field];
        let known = this.classDifferences.get(field);
        if (!known) this.classDifferences.set(field, (known = differenceOfClasses(surface, this.surfaces[1], field)));
        return known;
    }

    ends(surface: Surface): Ends {
        const { shown, formed, field } = this.store.state;
        const info = this.manifest.fields[field];
        if (formed && this.heightMap) return this.heightMap.info;
        if (shown !== 'difference' || info.classes) return info;
        let known = this.differenceEnds.get(field);
        if (!known) this.differenceEnds.set(field, (known = this.endsOfDifference(surface, field)));
        return known;
    }

    private endsOfDifference(surface: Surface, field: number): Ends {
        const info = this.manifest.fields[field];
        const values = this.difference(field).filter((v, i) => v === v && surface.kind(i) === Kind.cut);
        const sizes = values.map(Math.abs).sort();
        const last = sizes[sizes.length - 1] ?? 0;
        // Equal runs are not to look different: at least a tenth of the range of both.
        const most = Math.max(sizes[Math.floor(0.999 * (sizes.length - 1))] ?? 0, 0.1 * (info.high - info.low));
        return {
            low: -most,
            high: most,
            lowest: values.reduce((a, b) => Math.min(a, b), last),
            highest: values.reduce((a, b) => Math.max(a, b), -last),
        };
    }

    /** After minus before. */
    private difference(field: number): Float32Array {
        let known = this.differences.get(field);
        if (!known) this.differences.set(field, (known = differenceOf(this.surfaces[0], this.surfaces[1], field)));
        return known;
    }
}
