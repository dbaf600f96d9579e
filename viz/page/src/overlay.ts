// What stands over the surface: outlines of defects, the line and pass that are chosen, the cursor,
// the measure, scale bar, axes and legend; on a canvas of its own, in crisp pixels.

import { views, type Camera } from './camera';
import { colourAlong, cssColour, niceTicks, tickText, type ColourScale } from './colour';
import { fixedText } from './decimal_text';
import { styleValue } from './dom';
import { label } from './canvas_text';
import { drawClassLegend, drawHatched, drawPaler } from './class_legend';
import type { ShownClass } from './classes';
import { boxAt, labelPlace, markerPlace, meet, type Box } from './label_place';
import { boxesOf, drawRuler, rulerOf, type Ruler, type Zero } from './ruler';

export interface Polyline {
    xyz: number[]; // 3 per corner [mm] from the origin; open
    colour: string;
    width: number;
    between?: number; // [mm] to the next of many such lines
}

export interface Ring {
    at: readonly number[];
    colour: string;
    label: string;
    small: boolean;
}

/** The number of a defect, where it is strongest. */
export interface Tag {
    at: readonly number[];
    text: string;
    severity: number;
    chosen: boolean;
    defect: number | null; // its index; null: of one that is gone
}

export interface OverlayScene {
    tags: Tag[]; // the worst first
    polylines: Polyline[];
    rings: Ring[];
    scale: ColourScale;
    classes: ShownClass[] | null; // the legend of values that are names
    missing: boolean; // something has no value
    ramps: boolean; // the ends of passes have a lighter tone
    lowest: number; // of the values
    highest: number;
    title: string;
    unit: string;
    caption: string; // which log
    measure: readonly number[][]; // up to two places
    box: [number, number, number, number] | null; // of box zoom [px]
    wipe: number | null; // of the width
    zero: Zero;
}

export const legendWidth = 104; // px right of the map
const mostMoved = 60; // px from a place to its marker
const mostHidden = 99; // that have room in the caption
const crowdedRoom = 14; // px from line to line
const wipeLabels = 56; // px from the top: below the title and its caption

/** What is said of markers that do not fit; empty: all do. */
const hiddenText = (count: number) =>
    count === 0 ? '' : ` · ${count === 1 ? '1 marker does' : `${count} markers do`} not fit: zoom in`;

/** The length of the scale bar: a round number [mm]. */
function barLength(camera: Camera): number {
    const most = 160 * camera.mmPerPixel;
    const power = 10 ** Math.floor(Math.log10(most));
    return power * ([5, 2, 1].find((factor) => factor * power <= most) ?? 1);
}

export class Overlay {
    private markers: { box: Box; tag: Tag }[] = []; // that are drawn
    private hidden = 0; // markers that have no room
    private ruler: Ruler | null = null; // of a view along an axis

    constructor(readonly canvas: HTMLCanvasElement) {}

    draw(camera: Camera, scene: OverlayScene, ratio: number): void {
        const { width, height } = camera;
        this.canvas.width = Math.round((width + legendWidth) * ratio);
        this.canvas.height = Math.round(height * ratio);
        const g = this.canvas.getContext('2d') as CanvasRenderingContext2D;
        g.scale(ratio, ratio);
        g.font = `12px ${styleValue('--font')}`;
        const ink = styleValue('--ink');
        const halo = styleValue('--view');
        this.ruler = rulerOf(g, camera, scene.zero);
        for (const line of scene.polylines) this.polyline(g, camera, line, halo);
        // A marker is over the ring of its point: its number stays readable.
        for (const ring of scene.rings) this.ring(g, camera, ring, halo);
        const reserved = this.reserved(g, camera, scene);
        this.tags(g, camera, scene.tags, reserved, halo);
        const taken = [...reserved, ...this.markers.map(({ box }) => box)];
        for (const ring of scene.rings) if (ring.label) this.ringLabel(g, camera, ring, taken, halo);
        if (scene.measure.length > 0) this.measure(g, camera, scene.measure, taken, ink, halo);
        if (scene.box) {
            const [x0, y0, x1, y1] = scene.box;
            g.setLineDash([5, 4]);
            g.strokeStyle = ink;
            g.strokeRect(Math.min(x0, x1) + 0.5, Math.min(y0, y1) + 0.5, Math.abs(x1 - x0), Math.abs(y1 - y0));
            g.setLineDash([]);
        }
        if (scene.wipe !== null) {
            const x = Math.round(scene.wipe * width) + 0.5;
            g.strokeStyle = ink;
            g.beginPath();
            g.moveTo(x, 0);
            g.lineTo(x, height);
            g.stroke();
            const y = wipeLabels;
            label(g, 'before', x - 8, y, ink, halo, 'right');
            label(g, 'after', x + 8, y, ink, halo, 'left');
        }
        this.legend(g, camera, scene, ink, halo);
        this.axes(g, camera, ink, halo);
        this.scaleBar(g, camera, ink, halo);
        if (this.ruler) drawRuler(g, this.ruler, camera, styleValue('--faint'), halo);
    }

    private polyline(g: CanvasRenderingContext2D, camera: Camera, line: Polyline, halo: string): void {
        const count = line.xyz.length / 3;
        if (count === 0) return;
        const path = new Path2D();
        for (let i = 0; i < count; ++i) {
            const [x, y] = camera.project(line.xyz.slice(3 * i, 3 * i + 3));
            if (i === 0) path.moveTo(x, y);
            else path.lineTo(x, y);
        }
        g.lineJoin = 'round';
        g.lineCap = 'round';
        // Many lines close together would hide the map.
        const room = line.between ? line.between / camera.mmPerPixel : Infinity;
        const crowded = room < crowdedRoom;
        if (!crowded) {
            g.strokeStyle = halo;
            g.lineWidth = line.width + 2.5;
            g.stroke(path);
        }
        g.strokeStyle = line.colour;
        g.lineWidth = crowded ? Math.max(0.7, Math.min(line.width, room / 6)) : line.width;
        g.stroke(path);
        g.lineWidth = 1;
    }

    /** What stands at fixed places: the title, the axes, the scale bar. */
    private reserved(g: CanvasRenderingContext2D, camera: Camera, scene: OverlayScene): Box[] {
        const font = styleValue('--font');
        g.font = `600 12px ${font}`;
        const title = 16 + g.measureText(scene.title).width;
        g.font = `12px ${font}`;
        const caption = 16 + g.measureText(scene.caption + hiddenText(mostHidden)).width;
        const { ruler } = this;
        const [left, bottom] = this.corner(camera);
        return [
            ...(ruler ? boxesOf(ruler, camera, (text) => g.measureText(text).width) : []),
            { left: 0, top: 0, right: title, bottom: 27 },
            { left: 0, top: 27, right: caption, bottom: scene.caption ? 45 : 27 },
            { left: 0, top: bottom - 96, right: left + 96, bottom },
            { left: left + 96, top: bottom - 46, right: left + 110 + barLength(camera) / camera.mmPerPixel, bottom },
        ];
    }

    /** The lower left corner of what the edges leave. */
    private corner(camera: Camera): [number, number] {
        return [this.ruler?.left ?? 0, camera.height - (this.ruler?.below ?? 0)];
    }

    /** Where two would lie on each other, the worse one stays and the other one moves, with a line to its place. */
    private tags(g: CanvasRenderingContext2D, camera: Camera, tags: Tag[], reserved: Box[], halo: string): void {
        this.markers = [];
        this.hidden = 0;
        const taken = [...reserved];
        const size = [camera.width, camera.height];
        const placed: { tag: Tag; place: readonly number[]; x: number; y: number; half: number; colour: string }[] = [];
        g.font = `600 11px ${styleValue('--font')}`;
        for (const tag of [...tags].sort((a, b) => Number(b.chosen) - Number(a.chosen))) {
            const place = camera.project(tag.at);
            if (place[0] < 0 || place[1] < 0 || place[0] > size[0] || place[1] > size[1]) continue;
            const half = Math.max(8, g.measureText(tag.text).width / 2 + 4);
            const [x, y] = markerPlace(place, [half + 2, 10], taken, size);
            const box = boxAt(x, y, half + 2, 10);
            const far = Math.hypot(x - place[0], y - place[1]) > mostMoved && this.markers.length > 0;
            if (far || this.markers.some((other) => meet(other.box, box))) {
                ++this.hidden;
                continue;
            }
            this.markers.push({ box, tag });
            taken.push(box);
            const colour = tag.chosen ? styleValue('--accent') : styleValue(`--severity-${tag.severity}`);
            placed.push({ tag, place, x, y, half, colour });
        }
        // All lines lie below all markers.
        for (const { place, x, y, colour } of placed)
            if (Math.hypot(x - place[0], y - place[1]) > 9) leader(g, place, [x, y], colour, halo);
        for (const { tag, x, y, half, colour } of placed) marker(g, tag, [x, y], half, colour, halo);
        g.lineWidth = 1;
    }

    /** The marker at a pixel. */
    tagAt(x: number, y: number): Tag | null {
        const found = this.markers.find(({ box }) => meet(box, boxAt(x, y, 1, 1)));
        return found?.tag ?? null;
    }

    private ring(g: CanvasRenderingContext2D, camera: Camera, ring: Ring, halo: string): void {
        const [x, y] = camera.project(ring.at);
        for (const [colour, width] of [
            [halo, 5],
            [ring.colour, 2.2],
        ] as const) {
            g.beginPath();
            g.arc(x, y, ring.small ? 4 : 8, 0, 2 * Math.PI);
            g.strokeStyle = colour;
            g.lineWidth = width;
            g.stroke();
        }
        g.lineWidth = 1;
    }

    private ringLabel(g: CanvasRenderingContext2D, camera: Camera, ring: Ring, taken: Box[], halo: string): void {
        const [x, y] = camera.project(ring.at);
        g.font = `600 12px ${styleValue('--font')}`;
        const size = [g.measureText(ring.label).width + 4, 17];
        const box = labelPlace([x, y], size, taken, [camera.width, camera.height]);
        label(g, ring.label, box.left + 2, (box.top + box.bottom) / 2, ring.colour, halo, 'left', true);
    }

    private measure(
        g: CanvasRenderingContext2D,
        camera: Camera,
        places: readonly number[][],
        taken: Box[],
        ink: string,
        halo: string,
    ): void {
        const pixels = places.map((p) => camera.project(p));
        if (pixels.length === 2) {
            const [[x0, y0], [x1, y1]] = pixels;
            g.strokeStyle = halo;
            g.lineWidth = 4;
            g.beginPath();
            g.moveTo(x0, y0);
            g.lineTo(x1, y1);
            g.stroke();
            g.strokeStyle = ink;
            g.lineWidth = 1.5;
            g.stroke();
            const d = places[1].map((c, k) => c - places[0][k]);
            // What is clicked is a point of the log: its positions have a few micrometres at best.
            const mm = (value: number) => fixedText(value, 3).replace('-', '−');
            const text = `${mm(Math.hypot(...d))} mm   ΔX ${mm(d[0])}  ΔY ${mm(d[1])}  ΔZ ${mm(d[2])}`;
            g.font = `600 12px ${styleValue('--font')}`;
            const size = [g.measureText(text).width + 4, 17];
            const box = labelPlace([(x0 + x1) / 2, (y0 + y1) / 2], size, taken, [camera.width, camera.height]);
            label(g, text, box.left + 2, (box.top + box.bottom) / 2, ink, halo, 'left', true);
        }
        for (const [x, y] of pixels) {
            g.fillStyle = ink;
            g.fillRect(x - 3, y - 3, 6, 6);
        }
        g.lineWidth = 1;
    }

    private legend(g: CanvasRenderingContext2D, camera: Camera, scene: OverlayScene, ink: string, halo: string): void {
        g.fillStyle = halo;
        g.fillRect(camera.width, 0, legendWidth, camera.height);
        label(g, scene.title, 12, 18, ink, halo, 'left', true);
        label(g, scene.caption + hiddenText(this.hidden), 12, 36, ink, halo, 'left');
        const box = { left: camera.width + 8, top: 14, right: camera.width + legendWidth, bottom: camera.height - 14 };
        if (scene.classes) drawClassLegend(g, scene.classes, scene.missing, box, ink);
        else this.ramp(g, camera, scene, ink, halo);
    }

    private ramp(g: CanvasRenderingContext2D, camera: Camera, scene: OverlayScene, ink: string, halo: string): void {
        const { scale } = scene;
        const left = camera.width + 10;
        const top = 58;
        const height = Math.max(60, Math.min(360, camera.height - top - 70));
        for (let y = 0; y < height; ++y) {
            g.fillStyle = cssColour(colourAlong(scale, 1 - (y + 0.5) / height));
            g.fillRect(left, top + y, 18, 1.5);
        }
        g.strokeStyle = ink;
        g.strokeRect(left - 0.5, top - 0.5, 19, height + 1);
        const arrow = (y: number, direction: number) => {
            g.beginPath();
            g.moveTo(left, y);
            g.lineTo(left + 18, y);
            g.lineTo(left + 9, y + 9 * direction);
            g.closePath();
            g.fillStyle = cssColour(direction < 0 ? scale.map.above : scale.map.below);
            g.fill();
            g.stroke();
        };
        if (scene.highest > scale.high + scale.slack) arrow(top - 1, -1);
        if (scene.lowest < scale.low - scale.slack) arrow(top + height + 1, 1);
        const ticks = niceTicks(scale.low, scale.high, height / 45);
        const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
        const text = (value: number, y: number, of: number, bold: boolean) =>
            label(g, tickText(value, of), left + 25, y, ink, halo, 'left', bold);
        text(scale.high, top, step / 10, true);
        text(scale.low, top + height, step / 10, true);
        for (const tick of ticks) {
            const y = top + height * (1 - (tick - scale.low) / (scale.high - scale.low || 1));
            if (y < top + 14 || y > top + height - 14) continue;
            g.beginPath();
            g.moveTo(left + 18, y);
            g.lineTo(left + 22, y);
            g.stroke();
            text(tick, y, step, false);
        }
        let below = top + height + 20;
        if (scene.missing) {
            drawHatched(g, left, below, ink);
            label(g, 'no value', left + 22, below + 6, ink, halo, 'left');
            below += 20;
        }
        if (scene.ramps) {
            drawPaler(g, left, below, scale, ink);
            label(g, 'ramps at', left + 22, below + 6, ink, halo, 'left');
            label(g, 'pass ends', left + 22, below + 20, ink, halo, 'left');
        }
        label(g, scene.unit ? `[${scene.unit}]` : '', left, top - 22, ink, halo, 'left', true);
    }

    /** The directions of X, Y and Z, lower left. */
    private axes(g: CanvasRenderingContext2D, camera: Camera, ink: string, halo: string): void {
        const { right, up } = camera.axes;
        const [left, bottom] = this.corner(camera);
        const [x0, y0] = [left + 46, bottom - 46];
        for (const [k, name] of ['X', 'Y', 'Z'].entries()) {
            const [dx, dy] = [right[k] * 30, -up[k] * 30];
            if (Math.hypot(dx, dy) < 4) continue;
            g.strokeStyle = ink;
            g.lineWidth = 1.5;
            g.beginPath();
            g.moveTo(x0, y0);
            g.lineTo(x0 + dx, y0 + dy);
            g.stroke();
            label(g, name, x0 + 1.35 * dx, y0 + 1.35 * dy, ink, halo, 'center', true);
        }
        g.lineWidth = 1;
    }

    private scaleBar(g: CanvasRenderingContext2D, camera: Camera, ink: string, halo: string): void {
        const length = barLength(camera);
        const [left, bottom] = this.corner(camera);
        const [x, y] = [left + 104.5, bottom - 22.5];
        g.strokeStyle = ink;
        g.beginPath();
        g.moveTo(x, y - 5);
        g.lineTo(x, y);
        g.lineTo(x + length / camera.mmPerPixel, y);
        g.lineTo(x + length / camera.mmPerPixel, y - 5);
        g.stroke();
        label(
            g,
            length < 0.1 ? `${Number((length * 1000).toPrecision(3))} µm` : `${Number(length.toPrecision(3))} mm`,
            x + length / camera.mmPerPixel / 2,
            y - 12,
            ink,
            halo,
            'center',
        );
    }
}

/** The capsule of a defect with its number. */
function marker(
    g: CanvasRenderingContext2D,
    tag: Tag,
    [x, y]: readonly number[],
    half: number,
    colour: string,
    halo: string,
): void {
    g.beginPath();
    g.roundRect(x - half, y - 8, 2 * half, 16, 8);
    g.fillStyle = colour;
    g.strokeStyle = halo;
    g.lineWidth = 3;
    g.stroke();
    g.fill();
    g.fillStyle = tag.chosen ? halo : '#ffffff';
    g.textAlign = 'center';
    g.textBaseline = 'middle';
    g.fillText(tag.text, x, y + 0.5);
}

/** A line from a place to its marker. */
function leader(
    g: CanvasRenderingContext2D,
    [x0, y0]: readonly number[],
    [x1, y1]: readonly number[],
    ink: string,
    halo: string,
): void {
    for (const [colour, width] of [
        [halo, 4],
        [ink, 1.5],
    ] as const) {
        g.strokeStyle = colour;
        g.lineWidth = width;
        g.beginPath();
        g.moveTo(x0, y0);
        g.lineTo(x1, y1);
        g.stroke();
    }
}

/** The name of a view, where it has one. */
export function viewName(camera: Camera): string {
    const found = Object.entries(views).find(([, [az, el]]) => az === camera.azimuth && el === camera.elevation);
    return found ? `view ${found[0]}` : `${camera.azimuth.toFixed(0)}°, ${camera.elevation.toFixed(0)}°`;
}
