// The `clsurf render` command line that draws what the page shows. The picture's size is such that its
// map has as many pixels as the page's view, so that both agree to the pixel.

import { dot, views, wholeScale, type Camera, type Extent } from './camera';
import type { Manifest } from './manifest';
import type { State } from './store';
import type { Surface } from './surface';

/** A word that a POSIX shell takes as it is. */
export function shellWord(text: string): string {
    return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", `'\\''`)}'`;
}

/** Where the map lies on a sheet with legend (Layout of viz/scene.cpp). */
function panelSize(width: number, height: number, names: boolean): [number, number] {
    const text = Math.min(60, Math.max(9, Math.min(0.75 * width, height) / (names ? 36 : 46)));
    const small = Math.max(8, 0.78 * text);
    return [Math.floor(width - (names ? 15 : 7.2) * text), Math.floor(height - 3 * small - 3.6 * text)];
}

/** The sheet whose map has a size. `names`: of classes, whose legend is wider. */
export function sheetSize(width: number, height: number, names = false): [number, number] {
    let sheet: [number, number] = [width, height];
    for (let i = 0; i < 40; ++i) {
        const panel = panelSize(...sheet, names);
        if (panel[0] === width && panel[1] === height) break;
        sheet = [sheet[0] + width - panel[0], sheet[1] + height - panel[1]];
    }
    return sheet;
}

const rounded = (value: number, digits: number) => String(Number(value.toPrecision(digits)));

/** --view and --zoom of a camera on what has an extent along its axes. */
export function viewOptions(camera: Camera, extent: Extent): string[] {
    const named = Object.entries(views).find(
        ([, [az, el]]) => Math.abs(az - camera.azimuth) < 1e-9 && Math.abs(el - camera.elevation) < 1e-9,
    );
    const view = named ? named[0] : `${rounded(camera.azimuth, 6)},${rounded(camera.elevation, 6)}`;
    const axes = camera.axes;
    const whole = wholeScale(extent, camera.width, camera.height);
    const part = camera.mmPerPixel / whole;
    const x = 0.5 + (dot(axes.right, camera.centre) - (extent.low[0] + extent.high[0]) / 2) / (whole * camera.width);
    const y = 0.5 - (dot(axes.up, camera.centre) - (extent.low[1] + extent.high[1]) / 2) / (whole * camera.height);
    const options = ['--view', view];
    if (Math.abs(part - 1) > 1e-4 || Math.abs(x - 0.5) > 1e-4 || Math.abs(y - 0.5) > 1e-4) {
        options.push(
            '--zoom',
            [x - part / 2, y - part / 2, x + part / 2, y + part / 2].map((n) => n.toFixed(6)).join(','),
        );
    }
    return options;
}

export function renderCommand(
    manifest: Manifest,
    state: Readonly<State>,
    camera: Camera,
    surface: Surface,
    extent: Extent,
    dark: boolean,
): string {
    const { program, log, before, options } = manifest.command;
    const words = ['clsurf', 'render', program, state.shown === 'before' ? before : log, '-o', 'map.png', ...options];
    const field = manifest.fields[state.field];
    if (state.formed) words.push(...manifest.command.formed);
    else words.push('--color', field.name, '--surface', surface.roles[state.role].name);
    if (state.style !== 'surface' && !state.formed) words.push('--style', state.style);
    words.push(...viewOptions(camera, extent));
    const classes = field.classes && !state.formed;
    if (!classes && state.shown !== 'difference')
        words.push('--range', `${rounded(state.low, 7)},${rounded(state.high, 7)}`, '--colormap', state.map);
    if (state.bins > 0 && !classes && state.shown !== 'difference') words.push('--bins', String(state.bins));
    if (state.vertex !== null) words.push('--mark-point', String(surface.point[state.vertex]));
    if (state.line > 0 && surface.pointsOfLine(state.line).length > 0) words.push('--mark-line', String(state.line));
    if (state.defects && manifest.defects.length > 0) words.push('--defects');
    // `render` has one legend for both logs.
    const comparable = !classes || field.same_classes;
    if (comparable && (state.shown === 'wipe' || state.shown === 'difference')) words.push('--before', before);
    words.push('--no-axes', '--size');
    words.push(sheetSize(Math.round(camera.width), Math.round(camera.height), classes).join('x'));
    if (dark) words.push('--background', 'black');
    return words.map(shellWord).join(' ');
}
