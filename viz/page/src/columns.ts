// Packed columns (io/page/page_pack.h says how) → numbers.

import type { PackedColumn } from './manifest';

function bytesOfBase64(text: string): Uint8Array<ArrayBuffer> {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

/** The unpacked bytes of a block. Its element is emptied: a report of 30 MB needs its text only once. */
export async function readBytes(column: PackedColumn): Promise<Uint8Array> {
    const element = document.getElementById(`block-${column.block}`);
    if (!element) throw new Error(`the page has no block ${column.block}`);
    const packed = bytesOfBase64(element.textContent ?? '');
    element.textContent = '';
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Integers as doubles, exact up to 2^53, times `quantum`. */
export async function readNumbers(column: PackedColumn, quantum = 1): Promise<Float64Array> {
    const bytes = await readBytes(column);
    const { count, order, stride, planes } = column;
    const steps = new Float64Array(count);
    for (let plane = planes - 1; plane >= 0; --plane) {
        const at = plane * count;
        for (let i = 0; i < count; ++i) steps[i] = steps[i] * 256 + bytes[at + i];
    }
    for (let i = 0; i < count; ++i) {
        const folded = steps[i];
        const half = Math.floor(folded / 2);
        steps[i] = folded - 2 * half === 1 ? -half - 1 : half;
    }
    if (order === 1) {
        for (let i = stride; i < count; ++i) steps[i] += steps[i - stride];
    } else if (order === 2) {
        for (let i = stride; i < count; ++i)
            steps[i] += 2 * steps[i - stride] - (i >= 2 * stride ? steps[i - 2 * stride] : 0);
    }
    if (quantum !== 1) {
        for (let i = 0; i < count; ++i) steps[i] *= quantum;
    }
    return steps;
}

export async function readIndices(column: PackedColumn): Promise<Uint32Array> {
    return Uint32Array.from(await readNumbers(column));
}
