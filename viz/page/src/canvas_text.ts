// Texts on a canvas.

import { styleValue } from './dom';

/** A text in one line, with a border in the colour of what is behind it. */
export function label(
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
