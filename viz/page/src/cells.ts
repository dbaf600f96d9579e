// Cells of a mesh: pairs and triples of vertices.

import type { Surface } from './surface';

/** Corners of the way as pairs, for style lines. */
export function waySegments(surface: Surface): Uint32Array {
    const pairs: number[] = [];
    for (let i = 1; i < surface.count; ++i) if (surface.joined(i)) pairs.push(i - 1, i);
    return Uint32Array.from(pairs);
}

/** The cells of `size` corners whose corners are all shown. */
export function shownCells(corners: Uint32Array, size: number, shows: (vertex: number) => boolean): Uint32Array {
    const out: number[] = [];
    for (let at = 0; at + size <= corners.length; at += size) {
        const cell = corners.subarray(at, at + size);
        if (cell.every(shows)) out.push(...cell);
    }
    return Uint32Array.from(out);
}
