// The state of the page: one object, changed through set(), which tells who listens what changed.

import type { Opinions } from './accepted';
import type { DefectFilter } from './filters';

export type Style = 'surface' | 'lines' | 'points';
export type Shown = 'after' | 'before' | 'wipe' | 'difference';
export type Tool = 'turn' | 'box' | 'measure';

export interface State {
    field: number;
    map: string; // name of a colour map
    bins: number;
    low: number;
    high: number;
    style: Style;
    role: number; // of the surface's roles
    formed: boolean; // the as-machined surface in place of the CL surface
    defects: boolean; // outlined
    programmed: boolean; // the programmed path is drawn
    shown: Shown;
    playing: boolean;
    time: number | null; // [s] where the tool stands; null: it is not drawn
    wipe: number; // 0 … 1 of the width: left of it is before
    vertex: number | null; // the cursor, a vertex of the surface that is shown
    hover: number | null; // under the pointer
    line: number; // 0: none
    pass: number; // 0: none
    defect: number | null; // index
    pinned: number | null; // the defect whose card is open
    accepted: Opinions; // of the reader
    filter: DefectFilter; // of the defects that are listed and marked
    kinds: number; // of motion that are drawn: bits 1 << Kind
    passes: [number, number] | null; // that are drawn, first and last; null: all
    tool: Tool;
    over: 'time' | 'length';
    curves: number[]; // fields; the first follows `field`
    records: boolean; // the list of records in place of the curves
    theme: 'light' | 'dark';
    keys: boolean; // one-letter keys are on
}

/** The as-machined surface, of which there is no difference. */
export function showFormed({ shown }: Readonly<State>): Partial<State> {
    return { formed: true, shown: shown === 'difference' ? 'after' : shown };
}

type Listener = (state: Readonly<State>, changed: ReadonlySet<keyof State>) => void;

export class Store {
    private listeners: Listener[] = [];
    constructor(readonly state: State) {}

    on(listener: Listener): void {
        this.listeners.push(listener);
    }
    set(change: Partial<State>): void {
        const changed = new Set<keyof State>();
        for (const key of Object.keys(change) as (keyof State)[]) {
            if (Object.is(this.state[key], change[key])) continue;
            (this.state as unknown as Record<string, unknown>)[key] = change[key];
            changed.add(key);
        }
        if (changed.size === 0) return;
        for (const listener of this.listeners) listener(this.state, changed);
    }
}
