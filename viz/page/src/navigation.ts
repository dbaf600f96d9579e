// Going to a place of the part: a defect, one that is gone, a line, a point or a time.

import type { Defect, Manifest } from './manifest';
import { keeps } from './filters';
import type { ProgramText } from './program_text';
import type { Store } from './store';
import type { ViewPane } from './view_pane';

/** "#defect-10" is the tenth one. */
const defectLink = (index: number) => `#defect-${index + 1}`;
export function defectOfLink(hash: string, count: number): number | null {
    const number = Number(/^#defect-(\d+)$/.exec(hash)?.[1] ?? 0);
    return number >= 1 && number <= count ? number - 1 : null;
}

/** The field that shows a quantity best, among those of the page. */
function fieldOfQuantity(manifest: Manifest, quantity: Defect['quantity']): number | null {
    const names = {
        speed: ['speed_mismatch', 'feed_share', 'speed'],
        acceleration: ['acceleration_mismatch', 'acceleration'],
        lag: ['height'],
        relief: ['height'],
    }[quantity];
    for (const name of names) {
        const index = manifest.fields.findIndex((field) => field.name === name);
        if (index >= 0) return index;
    }
    return null;
}

export class Navigation {
    /** Set by the page: a defect has been selected. */
    showCard: () => void = () => undefined;

    constructor(
        private readonly manifest: Manifest,
        private readonly store: Store,
        private readonly text: ProgramText,
        private readonly view: ViewPane,
    ) {}

    readonly goToDefect = (index: number): void => {
        const { manifest, store, view } = this;
        const defect = manifest.defects[index];
        if (store.state.shown === 'before') store.set({ shown: 'after' });
        const surface = view.surface;
        const vertex = surface.vertexOfPoint(defect.point);
        // The numbers are those of the defect until the pointer moves.
        store.set({ defect: index, pinned: index, vertex, hover: null, line: surface.line[vertex], pass: 0 });
        const field = fieldOfQuantity(manifest, defect.quantity);
        if (field !== null && (field !== store.state.field || store.state.formed)) store.set({ field, formed: false });
        if (defect.normal) view.lookAlong(defect.normal);
        history.replaceState(null, '', defectLink(index));
        this.frame(defect.bounds_mm);
        this.showCard();
    };

    readonly goToGone = (index: number): void => {
        const { store, view } = this;
        const gone = this.manifest.gone[index];
        store.set({ shown: 'before', formed: false, defect: null, pinned: null, pass: 0 });
        const vertex = view.surface.vertexOfPoint(gone.point);
        store.set({ vertex, hover: null, line: view.surface.line[vertex] });
        this.frame(gone.bounds_mm);
    };

    /** To the next or the previous one of the defects that the filter keeps. */
    readonly stepDefect = (by: number): void => {
        const { manifest, store } = this;
        const kept = manifest.defects.map((_, k) => k).filter((k) => keeps(store.state, manifest.defects[k]));
        if (kept.length === 0) return;
        const at = kept.indexOf(store.state.defect ?? store.state.pinned ?? -1);
        this.goToDefect(kept[at < 0 ? (by > 0 ? 0 : kept.length - 1) : (at + by + kept.length) % kept.length]);
    };

    /** Returns what is wrong with the value; null: nothing. */
    readonly locate = (kind: string, value: number): string | null => {
        const { store, text } = this;
        const s = this.view.surface;
        if (kind === 'line') {
            if (value < 1 || value > text.lineCount || !Number.isInteger(value))
                return `the program has lines 1 … ${text.lineCount}`;
            const runs = s.runsOfLine(value);
            store.set({ line: value, vertex: runs.length > 0 ? runs[0][0] : null, defect: null, pass: 0 });
            return runs.length > 0 ? null : 'this report has no point on that line';
        }
        const last = kind === 'point' ? s.info.records - 1 : s.time[s.count - 1];
        if (value < 0 || value > last)
            return kind === 'point' ? `the log has points 0 … ${last}` : `the log lasts ${last.toFixed(3)} s`;
        const vertex = kind === 'point' ? s.vertexOfPoint(value) : s.vertexAtTime(value);
        store.set({ vertex, line: s.line[vertex], defect: null, pass: 0 });
        return null;
    };

    private frame(bounds: Defect['bounds_mm']): void {
        const origin = this.manifest.surfaces[0].origin_mm;
        this.view.goTo(
            bounds[0].map((c, k) => c - origin[k]),
            bounds[1].map((c, k) => c - origin[k]),
        );
    }
}
