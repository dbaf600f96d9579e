// The camera by keys, for whoever has no pointer: arrows turn, with shift they move, + and − zoom.

import type { Camera } from './camera';

const turned = 15; // px of a drag that turns as far
const moved = 40; // px
const zoomed = 1.25;

/** Listens at the view; `draw` after each change. */
export function listenToKeys(view: HTMLElement, camera: Camera, draw: () => void): void {
    view.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        const zoom = { '+': 1 / zoomed, '-': zoomed }[event.key];
        if (!arrow && !zoom) return;
        event.preventDefault();
        if (arrow && event.shiftKey) camera.pan(moved * arrow[0], moved * arrow[1]);
        else if (arrow) camera.turn(turned * arrow[0], turned * arrow[1]);
        else if (zoom) camera.zoom(zoom, camera.width / 2, camera.height / 2);
        draw();
    });
}
