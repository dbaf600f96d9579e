// Colour maps and scales, as viz/colour_map.cpp has them: the page and `render` show a value in the
// same colour.

import { fixedText } from './decimal_text';
import type { ColourMapInfo } from './manifest';

export type Rgb = [number, number, number];
export const missingColour: Rgb = [150, 150, 150];
const paleness = 0.6; // how far a lighter tone is from the colour to the lightest one of the ramp

export class ColourMap {
    readonly name: string;
    readonly summary: string;
    readonly centred: boolean;
    readonly below: Rgb;
    readonly above: Rgb;
    private readonly rgb: Uint8Array;

    constructor(info: ColourMapInfo) {
        this.name = info.name;
        this.summary = info.summary;
        this.centred = info.centred;
        this.below = info.below;
        this.above = info.above;
        this.rgb = Uint8Array.from(atob(info.rgb), (c) => c.charCodeAt(0));
    }
    /** x in 0 … 1; outside it the nearest end. */
    at(x: number): Rgb {
        const last = this.rgb.length / 3 - 1;
        const place = Math.min(Math.max(x, 0), 1) * last;
        const below = Math.min(Math.floor(place), last - 1);
        const t = place - below;
        const mix = (k: number) => Math.round(this.rgb[3 * below + k] * (1 - t) + this.rgb[3 * below + 3 + k] * t);
        return [mix(0), mix(1), mix(2)];
    }
}

export interface ColourScale {
    map: ColourMap;
    low: number;
    high: number;
    bins: number; // 0: none
    slack: number; // as far beyond an end a value still has the end's colour
}

/** As far beyond 0 … 1. */
export function slackAlong(scale: ColourScale): number {
    return scale.high > scale.low ? scale.slack / (scale.high - scale.low) : 0;
}

/** x = 0 … 1 of the range → colour; outside, the map's colours for that. In a centred map 0 has the middle, whatever the range. */
export function colourAlong(scale: ColourScale, x: number): Rgb {
    const { low, high, bins } = scale;
    if (!(high > low)) return scale.map.at(0.5);
    const slack = slackAlong(scale);
    if (x < -slack) return scale.map.below;
    if (x > 1 + slack) return scale.map.above;
    let at = Math.min(Math.max(x, 0), 1);
    if (bins > 0) at = (Math.min(Math.floor(at * bins), bins - 1) + 0.5) / bins;
    if (scale.map.centred && low < 0 && high > 0) at = 0.5 + (0.5 * (low + at * (high - low))) / Math.max(-low, high);
    return scale.map.at(at);
}

/** Colours along a scale, evenly, with those of values outside its range at the ends. */
export function rampOf(scale: ColourScale, count: number): Rgb[] {
    const along = Array.from({ length: count }, (_, i) => colourAlong(scale, i / (count - 1)));
    return [scale.map.below, ...along, scale.map.above];
}

/** The same colours in a lighter tone: nearer to the lightest one, by the rule of viz/canvas.cpp. */
export function paler(ramp: readonly Rgb[]): Rgb[] {
    const lightness = ([r, g, b]: Rgb) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const lightest = ramp.reduce((a, b) => (lightness(b) > lightness(a) ? b : a));
    return ramp.map((rgb) => rgb.map((c, k) => Math.round(c + paleness * (lightest[k] - c))) as Rgb);
}

export function cssColour(rgb: readonly number[]): string {
    return `rgb(${rgb[0]} ${rgb[1]} ${rgb[2]})`;
}

/** Round tick values in [low, high], about `wanted` of them. */
export function niceTicks(low: number, high: number, wanted: number): number[] {
    if (!(high > low)) return [low];
    const raw = (high - low) / Math.max(1, wanted);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * ([1, 2, 5].find((factor) => factor * power >= raw * 0.999) ?? 10);
    const ticks: number[] = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
    return ticks;
}

/** As many decimals as a step needs. */
export function tickText(value: number, step: number): string {
    const size = Math.max(Math.abs(value), step);
    if (size >= 1e6 || step < 1e-5) return value.toPrecision(3);
    const decimals = Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
    return fixedText(value, decimals);
}

/** "#rrggbb" → three numbers. */
export function rgbOf(colour: string): [number, number, number] {
    const value = Number.parseInt(colour.replace('#', ''), 16);
    return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}
