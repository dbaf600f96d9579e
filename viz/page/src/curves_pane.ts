// Signal curves over time or arc length: one chart a field, stacked, with common ends and cursor.

import uPlot from 'uplot';

import type { FieldClasses } from './classes';
import { cssColour } from './colour';
import { element, oncePerFrame, styleValue } from './dom';
import type { Manifest } from './manifest';
import type { Store } from './store';
import type { Surface } from './surface';
import { lowerBound, thinCurve } from './thin';

interface Chart {
    plot: uPlot;
    holder: HTMLElement;
    key: HTMLElement;
    field: number;
}

/** Arc length from the first vertex to each [mm]. */
function arcLengthOf(surface: Surface): Float64Array {
    const xyz = surface.roles[0].xyz;
    const arcLength = new Float64Array(surface.count);
    for (let i = 1; i < surface.count; ++i) {
        arcLength[i] =
            arcLength[i - 1] +
            Math.hypot(xyz[3 * i] - xyz[3 * i - 3], xyz[3 * i + 1] - xyz[3 * i - 2], xyz[3 * i + 2] - xyz[3 * i - 1]);
    }
    return arcLength;
}

export class CurvesPane {
    readonly element = element('div', { class: 'curves' });
    private readonly charts: Chart[] = [];
    private readonly arcLengths = new Map<Surface, Float64Array>();
    private low = 0;
    private high = 1;
    private readonly refill = oncePerFrame(() => this.fill());

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly surfaces: Surface[],
        private readonly surface: () => Surface,
    ) {
        store.on((state, changed) => {
            if (changed.has('field')) this.store.set({ curves: [state.field, ...state.curves.slice(1)] });
            if (changed.has('records')) this.element.hidden = state.records;
            if (changed.has('curves') || changed.has('theme')) this.build();
            else if (changed.has('over') || changed.has('shown')) {
                this.nameCurves();
                this.showAll();
            } else if (changed.has('vertex')) this.reveal();
            else if (changed.has('hover')) for (const chart of this.charts) chart.plot.redraw(false);
        });
        new ResizeObserver(() => this.resize()).observe(this.element);
    }

    private x(surface: Surface): Float64Array {
        if (this.store.state.over === 'time') return surface.time;
        let arcLength = this.arcLengths.get(surface);
        if (!arcLength) this.arcLengths.set(surface, (arcLength = arcLengthOf(surface)));
        return arcLength;
    }

    build(): void {
        for (const chart of this.charts) chart.plot.destroy();
        this.charts.length = 0;
        this.element.replaceChildren();
        const { curves } = this.store.state;
        curves.forEach((field, k) => this.add(field, k, k === curves.length - 1));
        this.nameCurves();
        this.showAll();
    }

    private add(field: number, index: number, last: boolean): void {
        const info = this.manifest.fields[field];
        const holder = element('div', { class: 'chart' });
        const key = element('ul', { class: 'key', tabindex: '0', 'aria-label': `legend of chart ${index + 1}` });
        holder.append(this.choiceOf(field, index), key);
        this.element.append(holder);
        const plot = new uPlot(this.plotOptions(field, last), [[0], [null], [null]], holder); // filled by fill()
        plot.over.addEventListener('click', (event) => this.click(plot, event.offsetX));
        plot.over.addEventListener('dblclick', () => this.showAll());
        plot.over.title = `${info.label}: click to select the place, drag to zoom, double click to show all`;
        this.charts.push({ plot, holder, key, field });
    }

    private choiceOf(field: number, index: number): HTMLSelectElement {
        const choice = element('select', { title: 'what this curve shows', 'aria-label': `curve ${index + 1}` });
        this.manifest.fields.forEach((f, k) =>
            choice.append(new Option(f.unit ? `${f.label} [${f.unit}]` : f.label, String(k), false, k === field)),
        );
        choice.addEventListener('change', () => {
            const curves = [...this.store.state.curves];
            curves[index] = Number(choice.value);
            if (index === 0) this.store.set({ field: curves[0] });
            else this.store.set({ curves });
        });
        return choice;
    }

    private plotOptions(field: number, last: boolean): uPlot.Options {
        const { classes } = this.manifest.fields[field];
        const grid = { stroke: styleValue('--line'), width: 1 };
        const font = `11px ${styleValue('--font')}`;
        const axis = { stroke: styleValue('--ink'), ticks: grid, font };
        return {
            width: 300,
            height: 80,
            padding: [classes ? 30 : 6, 12, last ? 0 : 6, 0], // names of classes; half a tick text
            legend: { show: false },
            cursor: { drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false },
            scales: { x: { time: false } },
            axes: [
                {
                    ...axis,
                    grid,
                    size: last ? 34 : 0,
                    show: last,
                    labelFont: font,
                    label: this.store.state.over === 'time' ? 'time [s]' : 'arc length [mm]',
                    labelSize: 13,
                    gap: 2,
                },
                {
                    ...axis,
                    grid: { ...grid, show: !classes },
                    size: 62,
                    gap: 3,
                    space: 22,
                    ...(classes ? { splits: () => [] } : {}),
                },
            ],
            // The other log lies behind.
            series: [
                {},
                { stroke: styleValue('--second'), width: 1.2, spanGaps: false, points: { show: false } },
                { stroke: styleValue('--curve'), width: 1.2, spanGaps: false, points: { show: false } },
            ],
            hooks: {
                draw: [(u) => this.drawBands(u, field), (u) => this.drawCursor(u)],
                setSelect: [(u) => this.zoomTo(u)],
            },
        };
    }

    /** The log that lies behind. */
    private get other(): Surface | undefined {
        const own = this.surface();
        return this.store.state.shown === 'before' ? undefined : this.surfaces.find((s) => s !== own);
    }

    /** The classes of a field in the logs that are drawn, the log before below. */
    private classesOf(field: number): { surface: Surface; classes: FieldClasses }[] {
        return [this.surface(), this.other].flatMap((surface) => {
            const classes = surface?.classes[field];
            return surface && classes ? [{ surface, classes }] : [];
        });
    }

    /** What the colours of each chart are: classes, and of two logs which is which. */
    private nameCurves(): void {
        for (const { key, field } of this.charts) {
            const entry = (name: string, colour: string, kind: string) => {
                const swatch = element('i', { class: kind });
                swatch.style.background = colour;
                return element('li', {}, swatch, name);
            };
            const classes = this.classesOf(field);
            const colours = new Map(
                classes.flatMap((c) => c.classes.shown.map(({ name, rgb }) => [name, cssColour(rgb)])),
            );
            const entries = [...colours].map(([name, colour]) => entry(name, colour, 'class'));
            if (classes.length > 1) entries.unshift(element('li', {}, 'after above, before below'));
            if (classes.length === 0 && this.other)
                entries.push(
                    entry('after', styleValue('--curve'), 'curve'),
                    entry('before', styleValue('--second'), 'curve'),
                );
            key.hidden = entries.length === 0;
            key.replaceChildren(...entries);
        }
    }

    private resize(): void {
        const last = this.charts.length - 1;
        const each = (this.element.clientHeight - 34) / Math.max(1, this.charts.length);
        this.charts.forEach((chart, k) => {
            const height = Math.max(40, Math.floor(each) + (k === last ? 34 : 0));
            chart.plot.setSize({ width: Math.max(120, this.element.clientWidth), height });
        });
        this.refill();
    }

    showAll(): void {
        const x = this.x(this.surface());
        this.range(x[0] ?? 0, x[x.length - 1] ?? 1);
        this.resize();
    }
    private range(low: number, high: number): void {
        [this.low, this.high] = [low, high > low ? high : low + 1];
        this.refill();
    }
    private zoomTo(plot: uPlot): void {
        const { left, width } = plot.select;
        if (width > 3) this.range(plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x'));
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    }

    private fill(): void {
        const columns = Math.max(100, Math.floor(this.element.clientWidth * devicePixelRatio));
        const own = this.surface();
        const { other } = this;
        const nothing = { x: [], y: [] };
        for (const { plot, field } of this.charts) {
            const named = this.manifest.fields[field].classes; // drawBands() draws them
            const thinned = (s: Surface) =>
                named ? nothing : thinCurve(this.x(s), s.fields[field], this.low, this.high, columns);
            const a = thinned(own);
            const b = other ? thinned(other) : nothing;
            const data =
                b.x.length > 0
                    ? uPlot.join([
                          [b.x, b.y],
                          [a.x, a.y],
                      ] as uPlot.AlignedData[])
                    : ([a.x, a.x.map(() => null), a.y] as uPlot.AlignedData);
            plot.setData(data, false);
            plot.batch(() => {
                plot.setScale('x', { min: this.low, max: this.high });
                const [least, most] = extremes([...a.y, ...b.y]);
                const room = 0.06 * (most - least || Math.abs(most) || 1);
                plot.setScale('y', { min: least - room, max: most + room });
            });
        }
    }

    /** Sections of one class in its colour. */
    private drawBands(plot: uPlot, field: number): void {
        const logs = this.classesOf(field);
        const { left, top, width, height } = plot.bbox;
        const each = height / Math.max(1, logs.length);
        const g = plot.ctx;
        logs.forEach(({ surface, classes }, row) => {
            const x = this.x(surface);
            const pixel = (vertex: number) =>
                Math.min(left + width, Math.max(left, plot.valToPos(x[Math.min(vertex, x.length - 1)], 'x', true)));
            let drawn = left;
            classes.starts.forEach((first, k) => {
                const to = pixel(classes.starts[k + 1] ?? x.length);
                const known = classes.of(first);
                // Each is at least a pixel wide; of several in one pixel the first one is seen.
                if (!known || to <= drawn) return;
                const from = Math.max(drawn, pixel(first));
                drawn = Math.min(left + width, Math.max(to, from + 1));
                g.fillStyle = cssColour(known.rgb);
                g.fillRect(from, top + row * each, drawn - from, row + 1 < logs.length ? each - 2 : each);
            });
        });
    }

    private drawCursor(plot: uPlot): void {
        const { vertex, hover } = this.store.state;
        const x = this.x(this.surface());
        const g = plot.ctx;
        for (const [at, colour, width] of [
            [hover, styleValue('--faint'), 1],
            [vertex, styleValue('--accent'), 2],
        ] as const) {
            if (at === null || x[at] < this.low || x[at] > this.high) continue;
            const pixel = Math.round(plot.valToPos(x[at], 'x', true));
            g.strokeStyle = colour;
            g.lineWidth = width * devicePixelRatio;
            g.beginPath();
            g.moveTo(pixel, plot.bbox.top);
            g.lineTo(pixel, plot.bbox.top + plot.bbox.height);
            g.stroke();
        }
    }

    private click(plot: uPlot, pixel: number): void {
        const surface = this.surface();
        const x = this.x(surface);
        const value = plot.posToVal(pixel, 'x');
        const after = Math.min(x.length - 1, lowerBound(x, value));
        const vertex = after > 0 && value - x[after - 1] < x[after] - value ? after - 1 : after;
        this.store.set({ vertex, line: surface.line[vertex], defect: null, pass: 0 });
    }

    /** Moves the window so that the cursor lies in it. */
    private reveal(): void {
        const { vertex } = this.store.state;
        if (vertex !== null) {
            const x = this.x(this.surface())[vertex];
            const half = (this.high - this.low) / 2;
            if (x < this.low || x > this.high) return this.range(x - half, x + half);
        }
        for (const chart of this.charts) chart.plot.redraw(false);
    }
}

function extremes(values: (number | null)[]): [number, number] {
    let [least, most] = [Infinity, -Infinity];
    for (const value of values) {
        if (value === null) continue;
        least = Math.min(least, value);
        most = Math.max(most, value);
    }
    return least <= most ? [least, most] : [0, 1];
}

/** A second field worth seeing next to the one that is shown. */
export function secondCurve(manifest: Manifest, first: number): number {
    for (const name of ['contour_error', 'speed_mismatch', 'acceleration', 'speed']) {
        const k = manifest.fields.findIndex((f) => f.name === name);
        if (k >= 0 && k !== first) return k;
    }
    return first;
}
