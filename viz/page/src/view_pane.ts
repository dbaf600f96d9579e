// The view: the surfaces of one or two logs on canvases of their own, what stands over them, and the
// pointer. Left of the wipe lies the log before.

import { Camera, extentAlong, views, wholeScale, type Extent } from './camera';
import { shownCells } from './cells';
import type { FieldClasses } from './classes';
import { rgbOf, type ColourMap, type ColourScale } from './colour';
import { afterRest, baseName, element, oncePerFrame, styleValue } from './dom';
import type { HeightMap } from './height_map';
import { Layer } from './layer';
import type { Manifest } from './manifest';
import { marksOf } from './marks';
import { legendWidth, Overlay, viewName, type OverlayScene } from './overlay';
import { drawTool } from './tool_shape';
import { listenToKeys } from './view_keys';
import { Picker } from './picker';
import type { ProgrammedPath } from './programmed';
import type { State, Store } from './store';
import { ShownValues, type Ends } from './shown_values';
import { Kind, type Surface } from './surface';

const slowFrame = 80; // ms
export const everyKind = (1 << Kind.cut) | (1 << Kind.link) | (1 << Kind.rapid);

export class ViewPane {
    readonly element = element('div', {
        class: 'view',
        tabindex: '0',
        role: 'group',
        'aria-label': 'the surface; arrow keys turn, with shift they move, plus and minus zoom',
    });
    readonly camera = new Camera();
    showDefect: (index: number) => void = () => undefined; // whose marker is clicked
    private readonly layers: Layer[] = [];
    private readonly overlay: Overlay;
    private readonly shown: ShownValues;
    private drag: { x: number; y: number; moved: boolean; pan: boolean; wipe: boolean } | null = null;
    private box: [number, number, number, number] | null = null;
    private readonly fingers = new Map<number, [number, number]>();
    private places: number[][] = [];
    private stale = true; // the surfaces must be drawn again, not only what stands over them
    private readonly drawLater = oncePerFrame(() => this.drawNow());
    private missing = false; // something that is drawn has no value
    private slow: boolean | null = null; // whether the machine is too slow to draw the whole mesh while it turns
    private readonly settle = afterRest(250, () => this.setCoarse(false));

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        surfaces: Surface[],
        private readonly maps: ColourMap[],
        private readonly heightMap: HeightMap | null,
        programmed: ProgrammedPath | null,
    ) {
        this.shown = new ShownValues(manifest, store, surfaces, heightMap);
        for (const surface of surfaces) {
            const layer = new Layer(this.element, surface);
            if (programmed) layer.view.setPath(programmed.xyz, programmed.segments);
            this.layers.push(layer);
        }
        const canvas = element('canvas', { class: 'overlay' });
        this.element.append(canvas);
        this.overlay = new Overlay(canvas);
        this.listen(canvas);
        listenToKeys(this.element, this.camera, () => this.drawMoving());
        store.on((_, changed) => this.update(changed));
        new ResizeObserver(() => this.resize()).observe(this.element);
    }

    /** The surface that the cursor belongs to. */
    get surface(): Surface {
        return this.active.surface;
    }
    private get active(): Layer {
        return this.layers[this.store.state.shown === 'before' && this.layers.length > 1 ? 1 : 0];
    }
    private get xyz(): Float32Array {
        return this.active.xyzOf(this.store.state.role);
    }
    placeOf(vertex: number): number[] {
        const { xyz } = this;
        return [xyz[3 * vertex], xyz[3 * vertex + 1], xyz[3 * vertex + 2]];
    }
    /** Where what is coloured are names; null: numbers. */
    get classes(): FieldClasses | null {
        return this.shown.classes(this.surface);
    }
    get scale(): ColourScale {
        return this.scaleOf(this.active);
    }
    private scaleOf(layer: Layer): ColourScale {
        const classes = this.shown.classes(layer.surface);
        if (classes) return classes.scale;
        const { map, low, high, bins, formed, field } = this.store.state;
        const readable = 0.005 * (high - low);
        const slack = formed ? readable : Math.max(readable, this.manifest.fields[field].slack);
        return { map: this.maps.find((m) => m.name === map) ?? this.maps[0], low, high, bins, slack };
    }

    /** The usual ends of the colours, and the lowest and highest value. */
    ends(): Ends {
        return this.shown.ends(this.surface);
    }
    /** The values that are coloured, one per vertex of what is shown. */
    get values(): Float32Array {
        return this.shown.of(this.surface);
    }

    // ---- what is shown ----

    begin(): void {
        this.resize();
        this.fit();
        this.update(new Set(['style', 'theme', 'map']));
    }

    private update(changed: ReadonlySet<keyof State>): void {
        const any = (...keys: (keyof State)[]) => keys.some((key) => changed.has(key));
        const mesh = ['style', 'role', 'formed', 'kinds', 'passes'] as const;
        const values = [...mesh, 'field', 'shown', 'low', 'high'] as const;
        for (const layer of this.layers) {
            if (any('theme')) {
                layer.view.setBackground(rgbOf(styleValue('--view')));
                layer.view.setPathColour(rgbOf(styleValue('--ink')));
            }
            if (any(...mesh) || !layer.isDividedBy(this.shown.classes(layer.surface))) this.remesh(layer);
            if (any(...values))
                layer.setValues(this.shown.of(layer.surface), this.scaleOf(layer), this.shown.pale(layer.surface));
            if (any(...values, 'map', 'bins', 'theme')) layer.view.setColours(this.scaleOf(layer));
        }
        if (any(...mesh, 'field', 'shown')) this.missing = this.active.lacksValues(this.values);
        if (any('tool')) this.element.dataset.tool = this.store.state.tool;
        if (any('programmed')) for (const layer of this.layers) layer.view.showPath(this.store.state.programmed);
        const { shown, wipe } = this.store.state;
        this.layers.forEach((layer, k) => {
            const seen = this.layers.length === 1 || shown === 'wipe' || (shown === 'before') === (k === 1);
            layer.box.style.visibility = seen ? 'visible' : 'hidden';
            layer.box.style.clipPath = shown === 'wipe' && k === 1 ? `inset(0 ${100 * (1 - wipe)}% 0 0)` : '';
        });
        if (any(...values, 'map', 'bins', 'theme', 'programmed')) this.draw();
        else if (changed.size > 1 || !changed.has('hover')) this.drawLater();
    }

    /** Draws the surfaces and what stands over them. */
    draw(): void {
        this.stale = true;
        this.drawLater();
    }
    /** Draws while the view moves: where the machine is slow, points in place of the mesh. */
    private drawMoving(): void {
        this.slow ??= this.active.view.timeOfPicture(this.camera) > slowFrame;
        if (this.slow) {
            this.setCoarse(true);
            this.settle();
        }
        this.draw();
    }
    private setCoarse(coarse: boolean): void {
        for (const layer of this.layers) if (layer.view.setCoarse(coarse)) this.stale = true;
        this.drawLater();
    }

    private remesh(layer: Layer): void {
        const { style, formed, role } = this.store.state;
        if (formed && this.heightMap && layer === this.layers[0]) return layer.showHeightMap(this.heightMap);
        const classes = this.shown.classes(layer.surface);
        layer.showSurface({ role, style, shows: this.shows(layer.surface), classes });
    }

    /** Whether a vertex is of the kinds and passes that are drawn; null: all are. */
    private shows(surface: Surface): ((vertex: number) => boolean) | null {
        const { kinds, passes } = this.store.state;
        if (kinds === everyKind && !passes) return null;
        const count = surface.info.pass_count; // the other log may have fewer
        const [first, last] = (passes ?? [1, count]).map((n) => Math.min(n, count));
        const from = passes ? surface.passes[2 * first - 2] : 0;
        const to = passes ? (surface.passes[2 * last - 1] ?? Infinity) : Infinity;
        return (i) => ((kinds >> surface.kind(i)) & 1) === 1 && surface.point[i] >= from && surface.point[i] <= to;
    }

    private resize(): void {
        const [width, height] = [this.element.clientWidth - legendWidth, this.element.clientHeight];
        if (width < 1 || height < 1) return;
        this.camera.width = width;
        this.camera.height = height;
        for (const layer of this.layers) layer.view.resize(width, height, devicePixelRatio);
        this.draw();
    }

    /** Of all that is shown. */
    extent(): Extent {
        const { surface, heightMap } = this;
        if (this.store.state.formed && heightMap)
            return extentAlong(this.camera.axes, heightMap.xyz, (i) => heightMap.missing[i] !== 1);
        return extentAlong(this.camera.axes, this.xyz, (i) => surface.kind(i) !== Kind.rapid);
    }
    fit(): void {
        this.camera.fit(this.extent());
        this.draw();
    }
    look(name: string): void {
        [this.camera.azimuth, this.camera.elevation] = views[name];
        this.fit();
    }
    /** From where a direction points to. The picture is drawn later. */
    lookAlong(normal: readonly number[]): void {
        const [x, y, z] = normal;
        const degrees = 180 / Math.PI;
        if (Math.abs(z) < 0.999) this.camera.azimuth = Math.atan2(x, -y) * degrees;
        else this.camera.azimuth = 0;
        this.camera.elevation = Math.asin(Math.min(1, Math.max(-1, z))) * degrees;
    }
    /** Brings places into the picture, at a size at which they can be read. */
    goTo(low: readonly number[], high: readonly number[]): void {
        const step = this.surface.info.step_over_mm || 1;
        this.camera.centre = [0, 1, 2].map((k) => (low[k] + high[k]) / 2) as [number, number, number];
        const size = Math.max(Math.hypot(...[0, 1, 2].map((k) => high[k] - low[k])), 12 * step);
        this.camera.mmPerPixel = (2.2 * size) / Math.min(this.camera.width, this.camera.height);
        const whole = this.extent();
        if (this.camera.mmPerPixel > wholeScale(whole, this.camera.width, this.camera.height)) this.camera.fit(whole);
        this.draw();
    }
    /** Moves the picture so that a vertex lies in it, if it does not. */
    reveal(vertex: number): void {
        const [x, y] = this.camera.project(this.placeOf(vertex));
        const inside = x > 30 && y > 30 && x < this.camera.width - 30 && y < this.camera.height - 30;
        if (!inside) this.camera.centre = this.placeOf(vertex) as [number, number, number];
        this.draw();
    }
    clearMeasure(): void {
        this.places = [];
        this.draw();
    }

    private drawNow(): void {
        if (this.stale) {
            this.stale = false;
            for (const layer of this.layers)
                if (layer.box.style.visibility !== 'hidden') layer.view.render(this.camera);
        }
        this.drawOverlay();
        this.element.dataset.view = viewName(this.camera);
        this.element.dataset.drawn = String(Number(this.element.dataset.drawn ?? 0) + 1);
    }

    // ---- what stands over it ----

    private scene(): OverlayScene {
        const { state } = this.store;
        const field = this.manifest.fields[state.field];
        const formed = state.formed && this.heightMap ? this.heightMap.info : null;
        const { surface } = this;
        return {
            ...marksOf(this.manifest, state, surface, this.xyz, surface === this.layers[0].surface),
            scale: this.scale,
            ...this.ends(),
            classes: this.classes?.shown ?? null,
            missing: this.missing,
            ramps: this.shown.pale(surface) !== null,
            title: formed
                ? 'As-machined surface over its form'
                : state.shown === 'difference'
                  ? `${field.label}, after ${this.classes ? 'against' : 'minus'} before`
                  : field.label,
            unit: formed ? 'µm' : this.classes ? '' : field.unit,
            caption:
                (this.layers.length > 1 && (state.shown === 'before' || state.shown === 'after')
                    ? `${state.shown}: ${baseName(surface.info.log)}, `
                    : '') + viewName(this.camera),
            measure: this.places,
            box: this.box,
            wipe: state.shown === 'wipe' ? state.wipe : null,
            zero: { origin: this.manifest.surfaces[0].origin_mm, system: this.manifest.work_system },
        };
    }

    private drawOverlay(): void {
        this.overlay.draw(this.camera, this.scene(), devicePixelRatio);
        const { time } = this.store.state;
        if (time === null) return;
        const { surface } = this;
        const g = this.overlay.canvas.getContext('2d') as CanvasRenderingContext2D;
        drawTool(g, this.camera, this.manifest.tool, surface, this.xyz, time);
    }

    // ---- the pointer ----

    pick(x: number, y: number): number | null {
        const { state } = this.store;
        if (x >= this.camera.width) return null; // the legend
        const layer = this.active;
        if (state.shown === 'wipe' && x < state.wipe * this.camera.width) return null; // before lies there; the cursor belongs to after
        const { surface } = layer;
        // A single pass has no triangles.
        const style = surface.triangles.length > 0 ? state.style : 'lines';
        const shows = this.shows(surface);
        layer.picker ??= new Picker(
            this.xyz,
            shows ? shownCells(surface.triangles, 3, shows) : surface.triangles,
            style,
            (i) => surface.kind(i) !== Kind.rapid && (shows?.(i) ?? true),
        );
        return layer.picker.pick(this.camera, x, y);
    }

    private listen(canvas: HTMLCanvasElement): void {
        const at = (event: MouseEvent): [number, number] => {
            const box = canvas.getBoundingClientRect();
            return [event.clientX - box.left, event.clientY - box.top];
        };
        canvas.addEventListener('contextmenu', (event) => event.preventDefault());
        canvas.addEventListener('pointerdown', (event) => {
            const [x, y] = at(event);
            this.fingers.set(event.pointerId, [x, y]);
            if (this.fingers.size > 1) {
                this.drag = this.box = null; // two fingers pinch
                return;
            }
            const { state } = this.store;
            const wipe = state.shown === 'wipe' && Math.abs(x - state.wipe * this.camera.width) < 8;
            this.drag = { x, y, moved: false, pan: event.button !== 0 || event.shiftKey, wipe };
            if (state.tool === 'box' && event.button === 0 && !wipe) this.box = [x, y, x, y];
            canvas.setPointerCapture(event.pointerId);
            this.element.focus({ preventScroll: true });
        });
        canvas.addEventListener('pointermove', (event) => {
            const [x, y] = at(event);
            if (this.fingers.size > 1) this.pinch(event.pointerId, x, y);
            else if (this.drag) this.dragTo(x, y);
            else this.hover(x, y);
        });
        canvas.addEventListener('pointerup', (event) => {
            const [x, y] = at(event);
            this.fingers.delete(event.pointerId);
            this.drop(x, y);
        });
        canvas.addEventListener('pointercancel', (event) => {
            this.fingers.delete(event.pointerId);
            this.drag = this.box = null;
        });
        canvas.addEventListener('pointerleave', () => {
            this.hoverAt = null; // also for a question that was asked already
            this.hoverLater();
        });
        canvas.addEventListener('dblclick', () => this.fit());
        canvas.addEventListener(
            'wheel',
            (event) => {
                event.preventDefault();
                this.camera.zoom(1.0015 ** event.deltaY, ...at(event));
                this.drawMoving();
            },
            { passive: false },
        );
    }

    /** Two fingers move the picture between them and zoom it by their distance. */
    private pinch(finger: number, x: number, y: number): void {
        const fingers = () => [...this.fingers.values()].slice(0, 2);
        const [[ax, ay], [bx, by]] = fingers();
        this.fingers.set(finger, [x, y]);
        const [[cx, cy], [dx, dy]] = fingers();
        this.camera.pan((cx + dx - ax - bx) / 2, (cy + dy - ay - by) / 2);
        const factor = Math.hypot(bx - ax, by - ay) / Math.max(1, Math.hypot(dx - cx, dy - cy));
        this.camera.zoom(factor, (cx + dx) / 2, (cy + dy) / 2);
        this.drawMoving();
    }

    private dragTo(x: number, y: number): void {
        const drag = this.drag;
        if (!drag) return;
        const [dx, dy] = [x - drag.x, y - drag.y];
        if (!drag.moved && Math.hypot(dx, dy) < 3) return;
        drag.moved = true;
        if (drag.wipe) {
            this.store.set({ wipe: Math.min(0.98, Math.max(0.02, x / this.camera.width)) });
        } else if (this.box) {
            this.box = [this.box[0], this.box[1], x, y];
        } else if (drag.pan) {
            this.camera.pan(dx, dy);
        } else {
            this.camera.turn(dx, dy);
        }
        [drag.x, drag.y] = [x, y];
        if (drag.wipe || this.box) this.drawLater();
        else this.drawMoving();
    }

    private drop(x: number, y: number): void {
        const drag = this.drag;
        this.drag = null;
        if (this.box) {
            const [x0, y0, x1, y1] = this.box;
            this.box = null;
            if (Math.abs(x1 - x0) > 6 && Math.abs(y1 - y0) > 6) {
                this.camera.pan(this.camera.width / 2 - (x0 + x1) / 2, this.camera.height / 2 - (y0 + y1) / 2);
                this.camera.mmPerPixel *= Math.max(
                    Math.abs(x1 - x0) / this.camera.width,
                    Math.abs(y1 - y0) / this.camera.height,
                );
            }
            this.store.set({ tool: 'turn' });
            this.draw();
            return;
        }
        if (!drag || drag.moved) return;
        const defect = this.defectAt(x, y);
        if (defect !== null) return this.showDefect(defect);
        const vertex = this.pick(x, y);
        if (this.store.state.tool === 'measure') {
            if (vertex === null) return;
            this.places = this.places.length === 2 ? [this.placeOf(vertex)] : [...this.places, this.placeOf(vertex)];
            this.draw();
            return;
        }
        if (vertex !== null) this.store.set({ vertex, line: this.surface.line[vertex], defect: null, pass: 0 });
    }

    /** The defect whose marker is there. */
    private defectAt(x: number, y: number): number | null {
        return this.store.state.tool === 'turn' ? (this.overlay.tagAt(x, y)?.defect ?? null) : null;
    }

    private hoverAt: [number, number] | null = null;
    private readonly hoverLater = oncePerFrame(() =>
        this.store.set({ hover: this.hoverAt ? this.pick(...this.hoverAt) : null }),
    );
    private hover(x: number, y: number): void {
        this.hoverAt = [x, y];
        const defect = this.defectAt(x, y);
        this.overlay.canvas.style.cursor = defect === null ? '' : 'pointer';
        this.overlay.canvas.title = defect === null ? '' : `show defect ${this.manifest.defects[defect].id}`;
        this.hoverLater();
    }

    /** The view with all that stands over it, as PNG. */
    async picture(): Promise<Blob> {
        const canvas = element('canvas');
        const size = [this.camera.width, this.camera.height].map((n) => Math.round(n * devicePixelRatio));
        canvas.width = Math.round((this.camera.width + legendWidth) * devicePixelRatio);
        canvas.height = size[1];
        const g = canvas.getContext('2d') as CanvasRenderingContext2D;
        const { shown, wipe } = this.store.state;
        this.layers.forEach((layer, k) => {
            if (layer.box.style.visibility === 'hidden') return;
            layer.view.setCoarse(false);
            layer.view.render(this.camera); // a WebGL canvas keeps its picture only while this task lasts
            const part = shown === 'wipe' && k === 1 ? Math.round(size[0] * wipe) : size[0];
            if (part > 0) g.drawImage(layer.view.canvas, 0, 0, part, size[1], 0, 0, part, size[1]);
        });
        this.drawOverlay();
        g.drawImage(this.overlay.canvas, 0, 0);
        return new Promise((resolve, reject) =>
            canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture'))), 'image/png'),
        );
    }
}
