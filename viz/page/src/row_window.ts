// A scrolling list of which only the rows that are seen exist: ten million of them scroll as ten do.

import { oncePerFrame } from './dom';

export const rowHeight = 19;
const tallest = 8_000_000; // px that every browser's scroll bar can have

export class RowWindow {
    readonly draw = oncePerFrame(() => this.drawNow());

    /**
     * `scroller` has the scroll bar and holds `spacer`, as high as all rows, and `rows`, which are filled by `fill` with rows
     * from `begin` up to `end`, from 0. `header`: height of what stands above the rows [px].
     */
    constructor(
        private readonly scroller: HTMLElement,
        private readonly spacer: HTMLElement,
        private readonly rows: HTMLElement,
        private readonly count: () => number,
        private readonly fill: (begin: number, end: number) => HTMLElement[],
        private readonly header = 0,
    ) {
        scroller.addEventListener('scroll', () => this.draw());
        new ResizeObserver(() => this.draw()).observe(scroller);
        this.resize();
    }

    /** After a change of the number of rows. */
    resize(): void {
        this.spacer.style.height = `${this.height}px`;
    }
    private get height(): number {
        return Math.min(tallest, this.count() * rowHeight);
    }
    /** Of what shows rows [px]. */
    private get shown(): number {
        return Math.max(0, this.scroller.clientHeight - this.header);
    }
    /** Rows that are seen at once. */
    get seen(): number {
        return this.shown / rowHeight;
    }
    /** The row at the upper edge. A pixel of the scroll bar moves more than a row where the list is taller than it can be. */
    private get first(): number {
        const room = this.height - this.shown;
        const hidden = this.count() - this.seen;
        return room > 0 ? Math.max(0, (this.scroller.scrollTop / room) * hidden) : 0;
    }

    /** Scrolls so that a row is seen, in the middle if it was not. */
    reveal(row: number): void {
        if (row >= this.first + 1 && row + 1 <= this.first + this.seen - 1) return;
        const hidden = this.count() - this.seen;
        const room = this.height - this.shown;
        if (hidden > 0) this.scroller.scrollTop = (Math.max(0, Math.min(hidden, row - this.seen / 2)) / hidden) * room;
        this.drawNow(); // in this frame: while the tool moves there is a jump in each
    }

    drawNow(): void {
        const first = this.first;
        const begin = Math.floor(first);
        const end = Math.min(this.count(), begin + Math.ceil(this.seen) + 1);
        this.rows.replaceChildren(...this.fill(begin, end));
        this.rows.style.transform = `translateY(${this.scroller.scrollTop - (first - begin) * rowHeight}px)`;
    }
}
