// Millimetres along the left and the lower edge of a view that looks along an axis: a line with ticks, their numbers, and the
// axis.

import type { Camera } from './camera';
import { label } from './canvas_text';
import { niceTicks, tickText } from './colour';
import type { Box } from './label_place';

const tickLength = 5; // px
const tickGap = tickLength + 3; // px from the line to a number
const lineHeight = 12; // px of a number
const gap = 16; // px between two numbers, at least
const below = 22; // px of the lower edge with its numbers
const nameTop = 56; // px: below the title and its caption
const finest = 1e-4; // mm: positions have no more digits

interface Mark {
    at: number; // px from the left, or from the top
    text: string;
}

export interface Ruler {
    across: Mark[];
    upward: Mark[];
    names: [string, string]; // of the axes across and upward
    left: number; // px of the left edge with its numbers
    below: number;
}

/** What the numbers count in. */
export interface Zero {
    origin: readonly number[]; // of the coordinates of the view [mm]
    system: string; // "G54"; empty: not known
}

/** The axis that a direction runs along, and whether against it; null: none. */
function axisAlong(direction: readonly number[]): { axis: number; sign: number } | null {
    const axis = direction.findIndex((c) => Math.abs(c) > 1 - 1e-9);
    return axis < 0 ? null : { axis, sign: Math.sign(direction[axis]) };
}

/** Round values from `first` at 0 px to `last` at `length` px, as many as have room. */
function marksAlong(first: number, last: number, length: number, sizeOf: (text: string) => number): Mark[] {
    const [low, high] = [Math.min(first, last), Math.max(first, last)];
    for (let wanted = length / (lineHeight + gap); wanted >= 1; wanted /= 1.3) {
        const ticks = niceTicks(low, high, wanted);
        if (ticks.length < 2) return [];
        const step = ticks[1] - ticks[0];
        if (step < finest) continue;
        const marks = ticks.map((value) => ({
            at: (length * (value - first)) / (last - first),
            text: tickText(value, step),
        }));
        const widest = Math.max(...marks.map(({ text }) => sizeOf(text)));
        if ((length * step) / (high - low) >= widest + gap) return marks;
    }
    return [];
}

/** Of a view that looks along an axis; null: it is oblique. */
export function rulerOf(g: CanvasRenderingContext2D, camera: Camera, zero: Zero): Ruler | null {
    const [right, up] = [axisAlong(camera.axes.right), axisAlong(camera.axes.up)];
    if (!right || !up) return null;
    const { width, height, mmPerPixel } = camera;
    const ends = ({ axis, sign }: { axis: number; sign: number }, pixels: number) => {
        const middle = zero.origin[axis] + camera.centre[axis];
        const half = (sign * pixels * mmPerPixel) / 2;
        return [middle - half, middle + half] as const;
    };
    const widthOf = (text: string) => g.measureText(text).width;
    const across = marksAlong(...ends(right, width), width, widthOf);
    const [bottom, top] = ends(up, height);
    const upward = marksAlong(top, bottom, height, () => lineHeight);
    return {
        across,
        upward,
        names: [`${'XYZ'[right.axis]} [mm${zero.system && `, ${zero.system}`}]`, `${'XYZ'[up.axis]} [mm]`],
        left: Math.ceil(4 + Math.max(0, ...upward.map(({ text }) => widthOf(text))) + tickGap),
        below,
    };
}

/** What it covers. */
export function boxesOf({ left, names }: Ruler, { width, height }: Camera, widthOf: (text: string) => number): Box[] {
    return [
        { left: 0, top: nameTop - 9, right: Math.max(left, 10 + widthOf(names[1])), bottom: nameTop + 9 },
        { left: 0, top: nameTop, right: left, bottom: height },
        { left: 0, top: height - below, right: width, bottom: height },
    ];
}

export function drawRuler(g: CanvasRenderingContext2D, ruler: Ruler, camera: Camera, ink: string, halo: string): void {
    const { width, height } = camera;
    const [x0, y0] = [ruler.left + 0.5, height - ruler.below + 0.5];
    const nameLeft = width - 6 - g.measureText(ruler.names[0]).width;
    const across = ruler.across.filter(({ at, text }) => {
        const half = g.measureText(text).width / 2;
        return at > x0 && at - half > 4 && at + half + gap < nameLeft;
    });
    const upward = ruler.upward.filter(({ at }) => at > nameTop + 18 && at < y0);
    g.beginPath();
    g.moveTo(x0, nameTop + 12);
    g.lineTo(x0, y0);
    g.lineTo(width, y0);
    for (const { at } of across) {
        g.moveTo(Math.round(at) + 0.5, y0);
        g.lineTo(Math.round(at) + 0.5, y0 + tickLength);
    }
    for (const { at } of upward) {
        g.moveTo(x0 - tickLength, Math.round(at) + 0.5);
        g.lineTo(x0, Math.round(at) + 0.5);
    }
    g.lineWidth = 1;
    g.strokeStyle = ink;
    g.stroke();
    for (const { at, text } of across) label(g, text, at, height - 8, ink, halo, 'center');
    for (const { at, text } of upward) label(g, text, x0 - tickGap, at, ink, halo, 'right');
    label(g, ruler.names[0], width - 6, height - 8, ink, halo, 'right');
    label(g, ruler.names[1], 4, nameTop, ink, halo, 'left');
}
