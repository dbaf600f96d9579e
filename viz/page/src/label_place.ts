// Where markers and labels stand in the picture, so that none covers another. Pure numbers, in pixels.

export interface Box {
    left: number;
    top: number;
    right: number;
    bottom: number;
}

export const boxAt = (x: number, y: number, halfWidth: number, halfHeight: number): Box => ({
    left: x - halfWidth,
    top: y - halfHeight,
    right: x + halfWidth,
    bottom: y + halfHeight,
});

/** The area that two boxes share. */
function shared(a: Box, b: Box): number {
    const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    return wide > 0 && high > 0 ? wide * high : 0;
}

export const meet = (a: Box, b: Box) => shared(a, b) > 0;

/** The middle of a marker: the place itself, or the nearest one inside the picture and off what is reserved for other things. */
export function markerPlace(
    [x, y]: readonly number[],
    [halfWidth, halfHeight]: readonly number[],
    reserved: readonly Box[],
    [width, height]: readonly number[],
): [number, number] {
    const hitBy = ([cx, cy]: readonly number[]) =>
        reserved.find((box) => meet(box, boxAt(cx, cy, halfWidth, halfHeight)));
    const inside: [number, number] = [
        Math.max(halfWidth, Math.min(width - halfWidth, x)),
        Math.max(halfHeight, Math.min(height - halfHeight, y)),
    ];
    const upright: [number, number] = [...inside];
    const aside: [number, number] = [...inside];
    // Each time past one of them, so that it ends also where they leave no room.
    reserved.forEach(() => {
        const [over, before] = [hitBy(upright), hitBy(aside)];
        if (over) upright[1] = over.top + over.bottom < height ? over.bottom + halfHeight : over.top - halfHeight;
        if (before) aside[0] = before.right + halfWidth;
    });
    const far = ([cx, cy]: readonly number[]) => (cx + halfWidth > width ? Infinity : Math.hypot(cx - x, cy - y));
    return far(aside) < far(upright) ? aside : upright;
}

/** The box of a label next to a ring: the nearest that covers nothing; else the one that covers least. */
export function labelPlace(
    [x, y]: readonly number[],
    [labelWidth, labelHeight]: readonly number[],
    taken: readonly Box[],
    [width, height]: readonly number[],
): Box {
    const beside = 13; // px from the middle of the ring
    let best: Box | null = null;
    let least = Infinity;
    for (const away of [12, 28, 44, 60]) {
        for (const [left, side] of [
            [x + beside, -1],
            [x - beside - labelWidth, -1],
            [x + beside, 1],
            [x - beside - labelWidth, 1],
            [x - labelWidth / 2, -1],
            [x - labelWidth / 2, 1],
        ]) {
            // Above and below the ring itself there is no room nearer than this.
            const distance = left < x && x < left + labelWidth ? Math.max(away, 19) : away;
            const middle = y + side * distance;
            const clamped = Math.max(0, Math.min(width - labelWidth, left));
            const box = {
                left: clamped,
                top: middle - labelHeight / 2,
                right: clamped + labelWidth,
                bottom: middle + labelHeight / 2,
            };
            const outside = box.top < 0 || box.bottom > height || clamped !== left ? labelWidth * labelHeight : 0;
            const cost = taken.reduce((sum, other) => sum + shared(box, other), outside);
            if (cost === 0) return box;
            if (cost >= least) continue;
            least = cost;
            best = box;
        }
    }
    return best as Box;
}
