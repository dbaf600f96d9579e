// Why the tool is slow at a vertex, in the words of `clsurf query`: here their pieces are joined only.

import { readBytes, readIndices, readNumbers } from './columns';
import type { SlowInfo } from './manifest';

export class SlowWords {
    constructor(
        private readonly speeds: Float64Array, // [mm/min] per vertex
        private readonly pieces: string[],
        private readonly columns: Uint32Array[], // the number of a piece per vertex
    ) {}

    /** "634 of F3000 mm/min: …"; empty: the tool is not slow there. */
    at(vertex: number): string {
        const words = this.columns.map((column) => this.pieces[column[vertex]]).join('');
        return words && `${this.speeds[vertex]} ${words}`;
    }
}

export async function readSlowWords(info: SlowInfo): Promise<SlowWords> {
    const text = new TextDecoder().decode(await readBytes(info.pieces));
    const columns: Uint32Array[] = [];
    for (const column of info.columns) columns.push(await readIndices(column));
    return new SlowWords(await readNumbers(info.speed), text.split('\n'), columns);
}
