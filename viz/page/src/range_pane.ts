// The range of the colours: a histogram of the cutting points with a handle at either end, and the two
// numbers to type.

import { shareText, type FieldClasses } from './classes';
import { colourAlong, cssColour } from './colour';
import { element, numberText, styleValue } from './dom';
import type { Store } from './store';
import { Kind } from './surface';
import type { ViewPane } from './view_pane';

const bars = 90;
const beside = 0.25; // of the usual range, seen to each side of it

export class RangePane {
    readonly element = element('div', { class: 'range' });
    private readonly canvas = element('canvas', {
        title: 'drag either end of the range; arrow keys move the high end, with shift the low one',
        tabindex: '0',
        'aria-label': 'colour range; arrow keys move the high end, with shift the low one',
    });
    private readonly low = element('input', { type: 'number', step: 'any', 'aria-label': 'lower end of the range' });
    private readonly high = element('input', { type: 'number', step: 'any', 'aria-label': 'upper end of the range' });
    private readonly title = element('h2', {}, 'Range');
    private readonly numbers: HTMLElement[]; // what sets a range
    private readonly classes = element('ul', { class: 'classes', hidden: '' });
    private counts = new Float64Array(bars);
    private from = 0;
    private to = 1;
    private difference = false; // of the range that is shown
    private dragged: 'low' | 'high' | null = null;

    constructor(
        private readonly store: Store,
        private readonly view: ViewPane,
    ) {
        const reset = element(
            'button',
            { title: 'the usual range: percentiles 1 to 99 of the cutting points', 'data-action': 'range-auto' },
            'usual',
        );
        const all = element(
            'button',
            { title: 'from the lowest to the highest value', 'data-action': 'range-all' },
            'all',
        );
        reset.addEventListener('click', () => this.reset());
        all.addEventListener('click', () => {
            const { lowest, highest } = this.view.ends();
            this.store.set({ low: lowest, high: highest });
        });
        for (const input of [this.low, this.high]) input.addEventListener('change', () => this.type());
        this.numbers = [this.canvas, element('div', { class: 'ends' }, this.low, this.high, reset, all)];
        this.element.append(this.title, ...this.numbers, this.classes);
        this.canvas.addEventListener('pointerdown', (event) => {
            const { low, high } = store.state;
            const x = this.valueAt(event.offsetX);
            this.dragged = Math.abs(x - low) <= Math.abs(x - high) ? 'low' : 'high';
            this.canvas.setPointerCapture(event.pointerId);
            this.drag(event.offsetX);
        });
        this.canvas.addEventListener('pointermove', (event) => this.dragged && this.drag(event.offsetX));
        this.canvas.addEventListener('pointerup', () => (this.dragged = null));
        this.canvas.addEventListener('keydown', (event) => {
            const step = ((this.to - this.from) / 100) * ({ ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? 0);
            if (step === 0) return;
            event.preventDefault();
            const { low, high } = store.state;
            if (event.shiftKey) this.put(low + step, high);
            else this.put(low, high + step);
        });
        store.on((_, changed) => {
            const difference = store.state.shown === 'difference';
            if (changed.has('field') || changed.has('formed') || difference !== this.difference) {
                this.difference = difference;
                this.reset();
            }
            if (
                ['field', 'formed', 'shown', 'theme', 'low', 'high', 'map', 'bins'].some((key) =>
                    changed.has(key as never),
                )
            ) {
                if (changed.has('field') || changed.has('formed') || changed.has('shown')) this.count();
                this.draw();
            }
        });
    }

    begin(): void {
        this.reset();
        this.count();
        this.draw();
    }

    private reset(): void {
        const { low, high } = this.view.ends();
        this.store.set({ low, high });
    }
    private put(low: number, high: number): void {
        if (low < high) this.store.set({ low, high });
    }
    private type(): void {
        const [low, high] = [Number(this.low.value), Number(this.high.value)];
        if (this.low.value !== '' && this.high.value !== '' && low < high) this.store.set({ low, high });
        else this.draw();
    }

    private count(): void {
        const { low, high, lowest, highest } = this.view.ends();
        const room = beside * (high - low || 1);
        this.from = Math.max(Math.min(lowest, low), low - room);
        this.to = Math.min(Math.max(highest, high), high + room);
        if (!(this.to > this.from)) [this.from, this.to] = [low - 1, high + 1];
        this.counts = new Float64Array(bars);
        const surface = this.view.surface;
        const values = this.view.values;
        for (let i = 0; i < values.length; ++i) {
            if (!this.store.state.formed && surface.kind(i) !== Kind.cut) continue;
            const k = Math.floor(((values[i] - this.from) / (this.to - this.from)) * bars);
            if (k >= 0 && k < bars) ++this.counts[k];
        }
    }

    private valueAt(x: number): number {
        return this.from + (x / this.canvas.clientWidth) * (this.to - this.from);
    }
    private drag(x: number): void {
        const value = Math.min(this.to, Math.max(this.from, this.valueAt(x)));
        const { low, high } = this.store.state;
        const least = (this.to - this.from) / 500;
        if (this.dragged === 'low') this.store.set({ low: Math.min(value, high - least) });
        else this.store.set({ high: Math.max(value, low + least) });
    }

    /** Names have no range: their classes with their shares. */
    private listClasses(classes: FieldClasses): void {
        this.classes.replaceChildren(
            ...classes.shown.map(({ name, rgb, share }) => {
                const swatch = element('i');
                swatch.style.background = cssColour(rgb);
                return element('li', {}, swatch, element('span', {}, name), element('small', {}, shareText(share)));
            }),
        );
    }

    private draw(): void {
        const { classes } = this.view;
        this.title.textContent = classes ? 'Shares of the cutting points' : 'Range';
        for (const part of this.numbers) part.hidden = classes !== null;
        this.classes.hidden = classes === null;
        if (classes) return this.listClasses(classes);
        const { low, high } = this.store.state;
        const digits = (value: number) => numberText(value, 5);
        this.low.value = digits(low);
        this.high.value = digits(high);
        const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
        if (width === 0) return;
        this.canvas.width = width * devicePixelRatio;
        this.canvas.height = height * devicePixelRatio;
        const g = this.canvas.getContext('2d') as CanvasRenderingContext2D;
        g.scale(devicePixelRatio, devicePixelRatio);
        const { scale } = this.view;
        const most = Math.max(1, ...this.counts);
        this.counts.forEach((count, k) => {
            const value = this.from + ((k + 0.5) / bars) * (this.to - this.from);
            // Square roots: a mark is some points among a million.
            const tall = Math.sqrt(count / most) * (height - 6);
            g.fillStyle = cssColour(colourAlong(scale, (value - low) / (high - low || 1)));
            g.fillRect((k / bars) * width, height - tall, width / bars + 0.5, tall);
        });
        const x = (value: number) =>
            Math.min(width - 1.5, Math.max(1.5, ((value - this.from) / (this.to - this.from)) * width));
        g.fillStyle = styleValue('--ink');
        for (const value of [low, high]) {
            g.fillRect(x(value) - 1, 0, 2, height);
            g.fillRect(x(value) - 4, 0, 8, 9);
        }
    }
}
