// Everything that a button or a key does: one table. Buttons, tooltips, keys and the help come from it.

import type { ViewPane } from './view_pane';
import type { Shown, Store } from './store';

export interface Action {
    name: string; // data-action of its button
    text: string; // on the button; empty: no button
    key: string; // as KeyboardEvent.key, lower case
    title: string;
    group: string;
    run: () => void;
    pressed?: () => boolean;
}

export interface Handlers {
    savePicture: () => void;
    showCommand: () => void;
    showHelp: () => void;
    play: () => void;
    locate: () => void;
    stepDefect: (by: number) => void;
}

function viewActions(view: ViewPane): Action[] {
    const look = (name: string, text: string, key: string): Action => ({
        name,
        text,
        key,
        title: `view ${name === 'iso' ? 'isometric' : `from ${name === 'top' ? 'above' : `the ${name}`}`}`,
        group: 'View',
        run: () => view.look(name),
    });
    return [
        look('iso', 'Iso', 'i'),
        look('top', 'Top', 't'),
        look('front', 'Front', 'f'),
        look('left', 'Left', 'l'),
        { name: 'fit', text: 'Fit', key: 'h', title: 'show the whole part', group: 'View', run: () => view.fit() },
    ];
}

function drawActions(store: Store): Action[] {
    const style = (name: 'surface' | 'lines' | 'points', key: string): Action => ({
        name,
        text: name[0].toUpperCase() + name.slice(1),
        key,
        title: `draw ${name === 'surface' ? 'the surface between passes' : name === 'lines' ? 'the tool path as lines' : 'the points only'}`,
        group: 'Draw',
        run: () => store.set({ style: name }),
        pressed: () => store.state.style === name,
    });
    return [style('surface', 's'), style('lines', 'n'), style('points', 'o')];
}

function toolActions(store: Store, view: ViewPane): Action[] {
    const { state } = store;
    const tool = (name: 'box' | 'measure', text: string, key: string, title: string): Action => ({
        name,
        text,
        key,
        title,
        group: 'Tool',
        run: () => {
            store.set({ tool: state.tool === name ? 'turn' : name });
            if (state.tool !== 'measure') view.clearMeasure();
        },
        pressed: () => state.tool === name,
    });
    return [
        tool('box', 'Box zoom', 'b', 'drag a box to zoom to it'),
        tool('measure', 'Measure', 'm', 'click two places to measure their distance'),
    ];
}

function defectActions(store: Store, stepDefect: (by: number) => void): Action[] {
    return [
        {
            name: 'defects',
            text: 'Outlines',
            key: 'u',
            title: 'outline the defects',
            group: 'Defects',
            run: () => store.set({ defects: !store.state.defects }),
            pressed: () => store.state.defects,
        },
        {
            name: 'previous-defect',
            text: '◀',
            key: 'v',
            title: 'the previous defect',
            group: 'Defects',
            run: () => stepDefect(-1),
        },
        {
            name: 'next-defect',
            text: 'Defect ▶',
            key: 'd',
            title: 'the next defect, the worst first',
            group: 'Defects',
            run: () => stepDefect(1),
        },
    ];
}

function cursorActions(store: Store, view: ViewPane, play: () => void): Action[] {
    const point = (by: number) => () => {
        const vertex = Math.min(view.surface.count - 1, Math.max(0, (store.state.vertex ?? 0) + by));
        store.set({ vertex, line: view.surface.line[vertex], defect: null, pass: 0 });
    };
    return [
        { name: 'point-before', text: '', key: ',', title: 'the previous point', group: 'Cursor', run: point(-1) },
        { name: 'point-after', text: '', key: '.', title: 'the next point', group: 'Cursor', run: point(1) },
        {
            name: 'play',
            text: '',
            key: 'a',
            title: 'play and pause the motion of the tool',
            group: 'Cursor',
            run: play,
        },
    ];
}

function curveActions(store: Store): Action[] {
    const { state } = store;
    return [
        {
            name: 'over',
            text: 'Time/path',
            key: 'x',
            title: 'curves over time or arc length',
            group: 'Curves',
            run: () => store.set({ over: state.over === 'time' ? 'length' : 'time' }),
        },
        {
            name: 'records',
            text: 'Records',
            key: 'j',
            title: 'the records of the log as a list, in place of the curves',
            group: 'Curves',
            run: () => store.set({ records: !state.records }),
            pressed: () => state.records,
        },
    ];
}

function colourActions(store: Store, view: ViewPane, maps: string[]): Action[] {
    return [
        {
            name: 'next-map',
            text: '',
            key: 'k',
            title: 'the next colour map',
            group: 'Colours',
            run: () =>
                view.classes === null && store.set({ map: maps[(maps.indexOf(store.state.map) + 1) % maps.length] }),
        },
    ];
}

function outputActions(handlers: Handlers): Action[] {
    return [
        {
            name: 'save',
            text: 'PNG',
            key: 'p',
            title: 'save the view as a picture',
            group: 'Out',
            run: handlers.savePicture,
        },
        {
            name: 'command',
            text: 'Command',
            key: 'r',
            title: 'the clsurf render command for this view',
            group: 'Out',
            run: handlers.showCommand,
        },
    ];
}

function pageActions(store: Store, handlers: Handlers): Action[] {
    return [
        {
            name: 'theme',
            text: 'Light/dark',
            key: 'y',
            title: 'light or dark',
            group: 'Page',
            run: () => store.set({ theme: document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark' }),
        },
        {
            name: 'locate',
            text: '',
            key: 'g',
            title: 'go to a point, a line or a time',
            group: 'Cursor',
            run: handlers.locate,
        },
        { name: 'help', text: '?', key: '?', title: 'all keys', group: 'Page', run: handlers.showHelp },
    ];
}

function compareActions(store: Store, differs: boolean): Action[] {
    const { state } = store;
    const left = { vertex: null, hover: null, pass: 0, defect: null }; // numbers of points are those of a log
    const shown = (name: Shown, key: string, title: string): Action => ({
        name,
        text: name[0].toUpperCase() + name.slice(1),
        key,
        title,
        group: 'Compare',
        run: () =>
            store.set(
                name === 'wipe'
                    ? { shown: name }
                    : name === 'difference'
                      ? { shown: name, formed: false, ...(state.shown === 'before' ? left : {}) }
                      : { shown: name, ...left },
            ),
        pressed: () => state.shown === name,
    });
    return [
        shown('before', '1', 'the earlier log'),
        shown('after', '2', 'the later log'),
        shown('wipe', 'w', 'before on the left, after on the right: drag the line between them'),
        ...(differs ? [shown('difference', 'e', 'after minus before, place by place')] : []),
        {
            name: 'toggle',
            text: '',
            key: 'c',
            title: 'switch to the other log',
            group: 'Compare',
            run: () => store.set({ shown: state.shown === 'before' ? 'after' : 'before', ...left }),
        },
    ];
}

export function actionsOf(
    store: Store,
    view: ViewPane,
    handlers: Handlers,
    logs: number,
    differs: boolean,
    maps: string[],
): Action[] {
    return [
        ...viewActions(view),
        ...drawActions(store),
        ...toolActions(store, view),
        ...defectActions(store, handlers.stepDefect),
        ...cursorActions(store, view, handlers.play),
        ...curveActions(store),
        ...colourActions(store, view, maps),
        ...outputActions(handlers),
        ...pageActions(store, handlers),
        ...(logs > 1 ? compareActions(store, differs) : []),
    ];
}
