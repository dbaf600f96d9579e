// The tool over the surface: its silhouette at a time of the log, and the way of its tip just before.

import type { Camera } from './camera';
import { styleValue } from './dom';
import type { ToolInfo } from './manifest';
import type { Surface } from './surface';

const trail = 0.5; // s
const shank = 3; // radii of the tool that are drawn above its edge
const angles = 36;
const rings = 9; // of the edge

/** Where the tool tip is at a time [mm from the origin], between two vertices where the way goes on. */
export function tipAt(surface: Surface, xyz: Float32Array, time: number): [number, number, number] {
    const after = surface.vertexFrom(time);
    const before = Math.max(0, after - 1);
    const at = (k: number) => [xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]] as [number, number, number];
    if (after === before || !surface.joined(after)) return at(after);
    const step = surface.time[after] - surface.time[before];
    const t = step > 0 ? Math.min(1, Math.max(0, (time - surface.time[before]) / step)) : 1;
    const [a, b] = [at(before), at(after)];
    return [0, 1, 2].map((k) => a[k] + t * (b[k] - a[k])) as [number, number, number];
}

/** Height over the tip and radius along the outline of the tool, from the tip up [mm]. */
function outlineOf({ radius_mm: radius, corner_mm: corner }: ToolInfo): [number, number][] {
    const outline: [number, number][] = [];
    for (let k = 0; k < rings; ++k) {
        const angle = ((k / (rings - 1)) * Math.PI) / 2;
        outline.push([corner * (1 - Math.cos(angle)), radius - corner + corner * Math.sin(angle)]);
    }
    outline.push([corner + shank * radius, radius]);
    return outline;
}

/** Corners of the smallest convex shape around points (Andrew 1979). */
export function convexHull(points: readonly [number, number][]): [number, number][] {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const half = (order: [number, number][]) => {
        const chain: [number, number][] = [];
        for (const p of order) {
            for (;;) {
                const [a, b] = chain.slice(-2);
                if (!b || (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
                chain.pop();
            }
            chain.push(p);
        }
        return chain.slice(0, -1);
    };
    return [...half(sorted), ...half(sorted.reverse())];
}

function strokeTrail(
    g: CanvasRenderingContext2D,
    camera: Camera,
    surface: Surface,
    xyz: Float32Array,
    time: number,
    tip: readonly number[],
): void {
    const first = surface.vertexFrom(time - trail);
    const path = new Path2D();
    let begun = false;
    for (let i = first; i < surface.count && surface.time[i] <= time; ++i) {
        const [x, y] = camera.project([xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]]);
        if (begun && surface.joined(i)) path.lineTo(x, y);
        else path.moveTo(x, y);
        begun = true;
    }
    const [x, y] = camera.project(tip);
    if (begun) path.lineTo(x, y);
    g.lineJoin = g.lineCap = 'round';
    for (const [colour, width] of [
        [styleValue('--view'), 5],
        [styleValue('--accent'), 2.5],
    ] as const) {
        g.strokeStyle = colour;
        g.lineWidth = width;
        g.stroke(path);
    }
}

/** Without a tool, or where its axis is not Z: the tip only. */
export function drawTool(
    g: CanvasRenderingContext2D,
    camera: Camera,
    tool: ToolInfo | undefined,
    surface: Surface,
    xyz: Float32Array,
    time: number,
): void {
    const tip = tipAt(surface, xyz, time);
    strokeTrail(g, camera, surface, xyz, time, tip);
    const [x, y] = camera.project(tip);
    g.fillStyle = styleValue('--accent');
    if (tool?.upright) {
        const ring = (height: number, radius: number) =>
            Array.from({ length: angles }, (_, k): [number, number] => {
                const angle = (2 * Math.PI * k) / angles;
                const corner = [tip[0] + radius * Math.cos(angle), tip[1] + radius * Math.sin(angle), tip[2] + height];
                return camera.project(corner).slice(0, 2) as [number, number];
            });
        const outline = outlineOf(tool);
        const fill = (corners: [number, number][], alpha: number) => {
            g.beginPath();
            corners.forEach(([px, py], k) => (k === 0 ? g.moveTo(px, py) : g.lineTo(px, py)));
            g.closePath();
            g.globalAlpha = alpha;
            g.fill();
            g.globalAlpha = 1;
            g.lineWidth = 1.5;
            g.strokeStyle = styleValue('--accent');
            g.stroke();
        };
        fill(convexHull(outline.flatMap(([height, radius]) => ring(height, radius))), 0.18);
        fill(ring(...outline[outline.length - 1]), 0.12); // its upper end
    }
    g.beginPath();
    g.arc(x, y, 3.5, 0, 2 * Math.PI);
    g.fill();
    g.lineWidth = 1;
}
