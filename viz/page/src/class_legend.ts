// The legend of a field whose values are names: colour, name and share of each; and swatches that other legends have, too.

import { shareText, type ShownClass } from './classes';
import { cssColour, missingColour, paler, rampOf, type ColourScale, type Rgb } from './colour';
import { styleValue } from './dom';
import type { Box } from './label_place';

const lineHeight = 14;
const gap = 7; // below a class
const swatch = [16, 12];

/** Words in lines of at most a width. */
function broken(g: CanvasRenderingContext2D, text: string, width: number): string[] {
    const lines: string[] = [];
    for (const word of text.split(' ')) {
        const longer = lines.length > 0 ? `${lines[lines.length - 1]} ${word}` : word;
        if (lines.length > 0 && g.measureText(longer).width <= width) lines[lines.length - 1] = longer;
        else lines.push(word);
    }
    return lines;
}

function strokeSwatch(g: CanvasRenderingContext2D, left: number, top: number, ink: string): void {
    g.strokeStyle = ink;
    g.lineWidth = 1;
    g.strokeRect(left - 0.5, top - 0.5, swatch[0] + 1, swatch[1] + 1);
}

/** What has no value. */
export function drawHatched(g: CanvasRenderingContext2D, left: number, top: number, ink: string): void {
    const [width, height] = swatch;
    g.save();
    g.beginPath();
    g.rect(left, top, width, height);
    g.clip();
    g.beginPath();
    for (let x = 4; x < width + height; x += 8) {
        g.moveTo(left + x, top);
        g.lineTo(left + x - height, top + height);
    }
    g.strokeStyle = cssColour(missingColour);
    g.lineWidth = 1.5;
    g.stroke();
    g.restore();
    strokeSwatch(g, left, top, ink);
}

/** The lighter tone of a scale: of what all passes have. */
export function drawPaler(
    g: CanvasRenderingContext2D,
    left: number,
    top: number,
    scale: ColourScale,
    ink: string,
): void {
    const [width, height] = swatch;
    paler(rampOf(scale, width))
        .slice(1, -1)
        .forEach((rgb, x) => {
            g.fillStyle = cssColour(rgb);
            g.fillRect(left + x, top, 1, height);
        });
    strokeSwatch(g, left, top, ink);
}

/** From the top of a box, the first ones; how many more there are is said where not all have room. */
export function drawClassLegend(
    g: CanvasRenderingContext2D,
    classes: readonly ShownClass[],
    missing: boolean,
    box: Box,
    ink: string,
): void {
    g.font = `11px ${styleValue('--font')}`;
    g.textAlign = 'left';
    g.textBaseline = 'middle';
    const left = box.left + swatch[0] + 5;
    const entries: { rgb: Rgb | null; lines: string[] }[] = classes.map(({ name, rgb, share }) => ({
        rgb,
        lines: [...broken(g, name, box.right - left), shareText(share)],
    }));
    if (missing) entries.push({ rgb: null, lines: ['no value'] });
    let y = box.top;
    for (const [k, { rgb, lines }] of entries.entries()) {
        const below = k + 1 < entries.length ? lineHeight : 0; // for the number of those that are left out
        if (y + lines.length * lineHeight + below > box.bottom) {
            g.fillStyle = ink;
            g.fillText(`and ${entries.length - k} more`, box.left, y + lineHeight / 2);
            return;
        }
        if (rgb) {
            g.fillStyle = cssColour(rgb);
            g.fillRect(box.left, y + 1, swatch[0], swatch[1]);
            strokeSwatch(g, box.left, y + 1, ink);
        } else {
            drawHatched(g, box.left, y + 1, ink);
        }
        g.fillStyle = ink;
        lines.forEach((line, row) => g.fillText(line, left, y + (row + 0.5) * lineHeight));
        y += lines.length * lineHeight + gap;
    }
}
