// The points of a curve that a width of pixels can show: the lowest and highest of each column, in their
// order, so that no extreme is lost.

export interface Thinned {
    x: number[];
    y: (number | null)[];
}

export function thinCurve(x: Float64Array, y: Float32Array, low: number, high: number, columns: number): Thinned {
    const from = Math.max(0, lowerBound(x, low) - 1);
    const to = Math.min(x.length - 1, lowerBound(x, high) + 1);
    const out: Thinned = { x: [], y: [] };
    const put = (i: number) => {
        out.x.push(x[i]);
        out.y.push(Number.isFinite(y[i]) ? y[i] : null);
    };
    if (to - from < 4 * columns) {
        for (let i = from; i <= to; ++i) put(i);
        return out;
    }
    const width = (to - from + 1) / columns;
    for (let c = 0; c < columns; ++c) {
        const begin = from + Math.floor(c * width);
        const end = Math.min(to, from + Math.floor((c + 1) * width) - 1);
        let [least, most] = [-1, -1];
        for (let i = begin; i <= end; ++i) {
            if (!(y[i] === y[i])) continue;
            if (least < 0 || y[i] < y[least]) least = i;
            if (most < 0 || y[i] > y[most]) most = i;
        }
        if (least < 0) put(begin);
        else if (least === most) put(least);
        else {
            put(Math.min(least, most));
            put(Math.max(least, most));
        }
    }
    return out;
}

/** The first index whose value is at least `value`. */
export function lowerBound(column: Float64Array, value: number): number {
    let low = 0;
    let high = column.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (column[middle] < value) low = middle + 1;
        else high = middle;
    }
    return low;
}
