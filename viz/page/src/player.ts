// Playback: the tool goes along its way at a chosen speed; line, curves and numbers follow.

import { element } from './dom';
import type { Store } from './store';
import type { Surface } from './surface';

const followEvery = 100; // ms: line, curves and numbers, while it plays

export class Player {
    readonly element = element('div', { class: 'player', role: 'group', 'aria-label': 'playback' });
    private readonly button = element('button', { 'data-action': 'play' });
    private readonly slider = element('input', { type: 'range', min: '0', step: 'any', 'aria-label': 'time' });
    private readonly clock = element('output', {}, '');
    private readonly rate = element('select', { 'aria-label': 'speed of playback' });
    private before = 0; // time of the frame before [ms]
    private followed = 0;

    constructor(
        private readonly store: Store,
        private readonly surface: () => Surface,
    ) {
        for (const [value, text] of [
            ['0.1', '0.1 ×'],
            ['0.5', '0.5 ×'],
            ['1', '1 ×'],
            ['5', '5 ×'],
            ['20', '20 ×'],
            ['100', '100 ×'],
        ])
            this.rate.append(new Option(text, value, value === '1', value === '1'));
        this.button.addEventListener('click', () => this.toggle());
        this.slider.addEventListener('input', () => {
            this.pause();
            this.moveTo(Number(this.slider.value));
        });
        this.element.append(this.button, this.slider, this.clock, this.rate);
        store.on((state, changed) => {
            if (changed.has('shown')) this.pause();
            // A place that is chosen elsewhere is where the tool goes.
            else if (changed.has('vertex') && !changed.has('time') && state.vertex !== null) {
                this.pause();
                const time = this.surface().time[state.vertex];
                if (state.time !== null) this.store.set({ time });
                else this.show(time);
            }
            if (changed.has('playing')) this.showState();
            if (changed.has('time') || changed.has('shown'))
                this.show(state.time ?? (state.vertex === null ? 0 : this.surface().time[state.vertex]));
        });
        this.showState();
        this.show(0);
    }

    private get end(): number {
        const { time } = this.surface();
        return time[time.length - 1] ?? 0;
    }

    private show(time: number): void {
        this.slider.max = String(this.end);
        this.slider.value = String(time);
        this.slider.setAttribute('aria-valuetext', `${time.toFixed(3)} s`);
        this.clock.textContent = `${time.toFixed(3)} s`;
    }

    private showState(): void {
        const { playing } = this.store.state;
        this.button.textContent = playing ? '❚❚' : '▶';
        this.button.title = playing ? 'pause' : 'play';
        this.button.setAttribute('aria-label', this.button.title);
    }

    /** Moves the tool and the cursor. */
    private moveTo(time: number): void {
        const surface = this.surface();
        const vertex = surface.vertexAtTime(time);
        this.store.set({ time, vertex, hover: null, line: surface.line[vertex], defect: null, pass: 0 });
    }

    toggle(): void {
        if (this.store.state.playing) return this.pause();
        this.store.set({ playing: true });
        const from = Number(this.slider.value);
        this.moveTo(from < this.end - 1e-6 ? from : 0);
        this.before = this.followed = performance.now();
        requestAnimationFrame(this.step);
    }

    private pause(): void {
        this.store.set({ playing: false });
    }

    private readonly step = (now: number): void => {
        if (!this.store.state.playing) return;
        const passed = Math.max(0, now - this.before) / 1000;
        this.before = now;
        const time = Math.min(this.end, (this.store.state.time ?? 0) + passed * Number(this.rate.value));
        const over = time >= this.end;
        if (over || now - this.followed >= followEvery) {
            this.followed = now;
            this.moveTo(time);
        } else {
            this.store.set({ time });
        }
        if (over) this.pause();
        else requestAnimationFrame(this.step);
    };
}
