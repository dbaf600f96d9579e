// Which vertex lies under the pointer. Vertices and triangles are sorted into cells of the picture when
// the first question after a turn is asked, so that every other one looks at one cell only.

import type { Camera } from './camera';
import type { Style } from './store';

const cell = 12; // px
const reach = 12; // px from a line or point

export class Picker {
    private camera: Camera | null = null;
    private pixels = new Float32Array(0); // x, y, nearness per vertex
    private columns = 0;
    private rows = 0;
    private first = new Uint32Array(0); // of each cell, in `items`
    private items = new Uint32Array(0); // triangles or vertices

    constructor(
        private xyz: Float32Array,
        private triangles: Uint32Array,
        private style: Style,
        private wanted: (vertex: number) => boolean,
    ) {}

    /** The vertex nearest to a pixel on what is seen there, or null. */
    pick(camera: Camera, x: number, y: number): number | null {
        if (!this.camera || !sameView(this.camera, camera)) this.sort(camera);
        return this.style === 'surface' ? (this.pickTriangle(x, y) ?? null) : this.pickVertex(x, y);
    }

    private sort(camera: Camera): void {
        this.camera = camera.copy();
        const { right, up, towards } = camera.axes;
        const { xyz } = this;
        const count = xyz.length / 3;
        const p = (this.pixels = new Float32Array(3 * count));
        const c = camera.centre;
        for (let i = 0; i < count; ++i) {
            const [dx, dy, dz] = [xyz[3 * i] - c[0], xyz[3 * i + 1] - c[1], xyz[3 * i + 2] - c[2]];
            p[3 * i] = (right[0] * dx + right[1] * dy) / camera.mmPerPixel + camera.width / 2;
            p[3 * i + 1] = camera.height / 2 - (up[0] * dx + up[1] * dy + up[2] * dz) / camera.mmPerPixel;
            p[3 * i + 2] = towards[0] * dx + towards[1] * dy + towards[2] * dz;
        }
        this.columns = Math.max(1, Math.ceil(camera.width / cell));
        this.rows = Math.max(1, Math.ceil(camera.height / cell));
        const counts = new Uint32Array(this.columns * this.rows + 1);
        this.eachCell((at) => ++counts[at + 1]);
        for (let i = 1; i < counts.length; ++i) counts[i] += counts[i - 1];
        this.first = counts.slice();
        this.items = new Uint32Array(counts[counts.length - 1]);
        this.eachCell((at, item) => (this.items[counts[at]++] = item));
    }

    /** Calls `visit` for every cell that a triangle or vertex touches. */
    private eachCell(visit: (at: number, item: number) => void): void {
        const p = this.pixels;
        const clampColumn = (x: number) => Math.min(this.columns - 1, Math.max(0, Math.floor(x / cell)));
        const clampRow = (y: number) => Math.min(this.rows - 1, Math.max(0, Math.floor(y / cell)));
        const [width, height] = [this.columns * cell, this.rows * cell];
        if (this.style === 'surface') {
            const t = this.triangles;
            for (let i = 0; i < t.length; i += 3) {
                const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
                const left = Math.min(p[a], p[b], p[c]);
                const right = Math.max(p[a], p[b], p[c]);
                const top = Math.min(p[a + 1], p[b + 1], p[c + 1]);
                const bottom = Math.max(p[a + 1], p[b + 1], p[c + 1]);
                if (right < 0 || bottom < 0 || left > width || top > height) continue;
                for (let row = clampRow(top); row <= clampRow(bottom); ++row) {
                    for (let column = clampColumn(left); column <= clampColumn(right); ++column)
                        visit(row * this.columns + column, i);
                }
            }
            return;
        }
        for (let i = 0; 3 * i < p.length; ++i) {
            if (!this.wanted(i) || p[3 * i] < 0 || p[3 * i + 1] < 0 || p[3 * i] >= width || p[3 * i + 1] >= height)
                continue;
            visit(clampRow(p[3 * i + 1]) * this.columns + clampColumn(p[3 * i]), i);
        }
    }

    private cellItems(column: number, row: number): Uint32Array {
        if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return this.items.subarray(0, 0);
        const at = row * this.columns + column;
        return this.items.subarray(this.first[at], this.first[at + 1]);
    }

    private pickTriangle(x: number, y: number): number | null {
        const p = this.pixels;
        const t = this.triangles;
        let best: number | null = null;
        let nearest = -Infinity;
        for (const i of this.cellItems(Math.floor(x / cell), Math.floor(y / cell))) {
            const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
            const area = (p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[b + 1] - p[a + 1]) * (p[c] - p[a]);
            if (area === 0) continue;
            const v = ((x - p[a]) * (p[c + 1] - p[a + 1]) - (y - p[a + 1]) * (p[c] - p[a])) / area;
            const w = ((p[b] - p[a]) * (y - p[a + 1]) - (p[b + 1] - p[a + 1]) * (x - p[a])) / area;
            if (v < 0 || w < 0 || v + w > 1) continue;
            const depth = p[a + 2] + v * (p[b + 2] - p[a + 2]) + w * (p[c + 2] - p[a + 2]);
            if (depth <= nearest) continue;
            nearest = depth;
            const from = (k: number) => (p[k] - x) ** 2 + (p[k + 1] - y) ** 2;
            best = [a, b, c].reduce((m, k) => (from(k) < from(m) ? k : m)) / 3;
        }
        return best;
    }

    private pickVertex(x: number, y: number): number | null {
        const p = this.pixels;
        let best: number | null = null;
        let least = reach * reach;
        const [column, row] = [Math.floor(x / cell), Math.floor(y / cell)];
        for (let r = row - 1; r <= row + 1; ++r) {
            for (let c = column - 1; c <= column + 1; ++c) {
                for (const i of this.cellItems(c, r)) {
                    const distance = (p[3 * i] - x) ** 2 + (p[3 * i + 1] - y) ** 2;
                    if (distance >= least) continue;
                    least = distance;
                    best = i;
                }
            }
        }
        return best;
    }
}

function sameView(a: Camera, b: Camera): boolean {
    return (
        a.azimuth === b.azimuth &&
        a.elevation === b.elevation &&
        a.mmPerPixel === b.mmPerPixel &&
        a.width === b.width &&
        a.height === b.height &&
        a.centre.every((c, k) => c === b.centre[k])
    );
}
