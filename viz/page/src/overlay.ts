// What stands over the surface: outlines of defects, the line and pass that are chosen, the cursor,
// the measure, scale bar, axes and legend; on a canvas of its own, in crisp pixels.

import { views, type Camera } from './camera';
import { colourAlong, cssColour, niceTicks, tickText, type ColourScale } from './colour';
import { styleValue } from './dom';

export interface Polyline {
    xyz: number[]; // 3 per corner [mm] from the origin
    closed: boolean;
    colour: string;
    width: number;
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
}

export interface OverlayScene {
    tags: Tag[]; // the worst first
    polylines: Polyline[];
    rings: Ring[];
    scale: ColourScale;
    lowest: number; // of the values
    highest: number;
    title: string;
    unit: string;
    caption: string; // which log
    measure: readonly number[][]; // up to two places
    box: [number, number, number, number] | null; // of box zoom [px]
    wipe: number | null; // of the width
}

export const legendWidth = 104; // px beside the map
const wipeLabels = 56; // px from the top: below the title and its caption

export class Overlay {
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
        for (const line of scene.polylines) this.polyline(g, camera, line, halo);
        this.tags(g, camera, scene.tags, halo);
        for (const ring of scene.rings) this.ring(g, camera, ring, halo);
        if (scene.measure.length > 0) this.measure(g, camera, scene.measure, ink, halo);
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
        if (line.closed) path.closePath();
        g.lineJoin = 'round';
        g.lineCap = 'round';
        g.strokeStyle = halo;
        g.lineWidth = line.width + 2.5;
        g.stroke(path);
        g.strokeStyle = line.colour;
        g.lineWidth = line.width;
        g.stroke(path);
        g.lineWidth = 1;
    }

    /** Where two would lie on each other, the worse one stays. */
    private tags(g: CanvasRenderingContext2D, camera: Camera, tags: Tag[], halo: string): void {
        const placed: number[][] = [];
        for (const tag of [...tags].sort((a, b) => Number(b.chosen) - Number(a.chosen))) {
            const [x, y] = camera.project(tag.at);
            if (placed.some(([px, py]) => Math.abs(px - x) < 22 && Math.abs(py - y) < 17)) continue;
            placed.push([x, y]);
            g.font = `600 11px ${styleValue('--font')}`;
            const half = Math.max(8, g.measureText(tag.text).width / 2 + 4);
            g.beginPath();
            g.roundRect(x - half, y - 8, 2 * half, 16, 8);
            g.fillStyle = tag.chosen ? styleValue('--accent') : styleValue(`--severity-${tag.severity}`);
            g.strokeStyle = halo;
            g.lineWidth = 3;
            g.stroke();
            g.fill();
            g.fillStyle = tag.chosen ? halo : '#ffffff';
            g.textAlign = 'center';
            g.textBaseline = 'middle';
            g.fillText(tag.text, x, y + 0.5);
        }
        g.lineWidth = 1;
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
        if (!ring.label) return;
        g.font = `600 12px ${styleValue('--font')}`;
        const room = g.measureText(ring.label).width + 18;
        const [align, at] =
            x + room < camera.width
                ? (['left', x + 13] as const)
                : x > room
                  ? (['right', x - 13] as const)
                  : (['center', Math.max(room / 2, Math.min(camera.width - room / 2, x))] as const);
        label(g, ring.label, at, y - (align === 'center' ? 17 : 12), ring.colour, halo, align, true);
    }

    private measure(
        g: CanvasRenderingContext2D,
        camera: Camera,
        places: readonly number[][],
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
            const text = `${Math.hypot(...d).toFixed(4)} mm   ΔX ${d[0].toFixed(4)}  ΔY ${d[1].toFixed(4)}  ΔZ ${d[2].toFixed(4)}`;
            label(g, text, (x0 + x1) / 2, (y0 + y1) / 2 - 12, ink, halo, 'center', true);
        }
        for (const [x, y] of pixels) {
            g.fillStyle = ink;
            g.fillRect(x - 3, y - 3, 6, 6);
        }
        g.lineWidth = 1;
    }

    private legend(g: CanvasRenderingContext2D, camera: Camera, scene: OverlayScene, ink: string, halo: string): void {
        const { scale } = scene;
        const left = camera.width + 10;
        const top = 58;
        const height = Math.max(60, Math.min(360, camera.height - top - 70));
        g.fillStyle = halo;
        g.fillRect(camera.width, 0, legendWidth, camera.height);
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
        label(g, scene.unit ? `[${scene.unit}]` : '', left, top - 22, ink, halo, 'left', true);
        label(g, scene.title, 12, 18, ink, halo, 'left', true);
        if (scene.caption) label(g, scene.caption, 12, 36, ink, halo, 'left');
    }

    /** The directions of X, Y and Z, lower left. */
    private axes(g: CanvasRenderingContext2D, camera: Camera, ink: string, halo: string): void {
        const { right, up } = camera.axes;
        const [x0, y0] = [46, camera.height - 46];
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
        const most = 160 * camera.mmPerPixel;
        const power = 10 ** Math.floor(Math.log10(most));
        const length = power * ([5, 2, 1].find((factor) => factor * power <= most) ?? 1);
        const [x, y] = [104.5, camera.height - 22.5];
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

function label(
    g: CanvasRenderingContext2D,
    text: string,
    x: number,
    y: number,
    ink: string,
    halo: string,
    align: CanvasTextAlign,
    bold = false,
): void {
    if (!text) return;
    g.font = `${bold ? '600 ' : ''}12px ${styleValue('--font')}`;
    g.textAlign = align;
    g.textBaseline = 'middle';
    g.lineJoin = 'round';
    g.lineWidth = 3.5;
    g.strokeStyle = halo;
    g.strokeText(text, x, y);
    g.fillStyle = ink;
    g.fillText(text, x, y);
    g.lineWidth = 1;
}

/** The name of a view, where it has one. */
export function viewName(camera: Camera): string {
    const found = Object.entries(views).find(([, [az, el]]) => az === camera.azimuth && el === camera.elevation);
    return found ? `view ${found[0]}` : `${camera.azimuth.toFixed(0)}°, ${camera.elevation.toFixed(0)}°`;
}
