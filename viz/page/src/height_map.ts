// The as-machined surface: a grid of heights with their deviations from the form.

import { readBytes, readNumbers } from './columns';
import type { HeightMapInfo } from './manifest';

export interface HeightMap {
    info: HeightMapInfo;
    xyz: Float32Array; // 3 per vertex [mm] from `origin`
    triangles: Uint32Array;
    deviation: Float32Array; // [µm]; NaN where the form is not known
    missing: Uint8Array; // per vertex: 1, there is none; 2, it has no deviation
}

export async function readHeightMap(info: HeightMapInfo, origin: readonly number[]): Promise<HeightMap> {
    const z = await readNumbers(info.z, info.z_quantum_mm);
    const deviation = Float32Array.from(await readNumbers(info.deviation, info.deviation_quantum_um));
    const missing = await readBytes(info.missing);
    missing.forEach((flag, i) => {
        if (flag === 2) deviation[i] = NaN;
    });
    const xyz = new Float32Array(3 * z.length);
    for (let i = 0; i < z.length; ++i) {
        xyz[3 * i] = info.origin_mm[0] - origin[0] + info.pitch_mm * (i % info.columns);
        xyz[3 * i + 1] = info.origin_mm[1] - origin[1] + info.pitch_mm * Math.floor(i / info.columns);
        xyz[3 * i + 2] = info.origin_mm[2] - origin[2] + z[i];
    }
    const triangles: number[] = [];
    const there = (...corners: number[]) => corners.every((c) => missing[c] !== 1);
    for (let row = 0; row + 1 < info.rows; ++row) {
        for (let column = 0; column + 1 < info.columns; ++column) {
            const a = row * info.columns + column;
            const [b, c, d] = [a + 1, a + info.columns, a + info.columns + 1];
            if (there(a, b, d)) triangles.push(a, b, d);
            if (there(a, d, c)) triangles.push(a, d, c);
        }
    }
    return { info, xyz, triangles: Uint32Array.from(triangles), deviation, missing };
}
