// The path as it is programmed, drawn in thin lines over the surface of a log.

import { readBytes, readNumbers } from './columns';
import type { ProgrammedInfo } from './manifest';

export interface ProgrammedPath {
    xyz: Float32Array; // 3 per corner [mm] from the origin of the surfaces
    segments: Uint32Array; // pairs of corners
}

export async function readProgrammed(info: ProgrammedInfo, origin: readonly number[]): Promise<ProgrammedPath> {
    const axes = await Promise.all([info.x, info.y, info.z].map((column) => readNumbers(column, info.quantum_mm)));
    const count = axes[0].length;
    const xyz = new Float32Array(3 * count);
    for (let k = 0; k < 3; ++k) for (let i = 0; i < count; ++i) xyz[3 * i + k] = axes[k][i] - origin[k];
    const begin = await readBytes(info.begin);
    const pairs: number[] = [];
    for (let i = 1; i < count; ++i) if (!begin[i]) pairs.push(i - 1, i);
    return { xyz, segments: Uint32Array.from(pairs) };
}
