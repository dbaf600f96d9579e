// Everything that a button or a key does: one table. Buttons, tooltips, keys and the help come from it.

import type { ViewPane } from './view_pane';
import type { Store } from './store';

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

export function actionsOf(
    store: Store,
    view: ViewPane,
    handlers: Handlers,
    logs: number,
    differs: boolean,
    maps: string[],
): Action[] {
    const { state } = store;
    const look = (name: string, text: string, key: string): Action => ({
        name,
        text,
        key,
        title: `view ${name === 'iso' ? 'isometric' : `from ${name === 'top' ? 'above' : `the ${name}`}`}`,
        group: 'View',
        run: () => view.look(name),
    });
    const style = (name: 'surface' | 'lines' | 'points', key: string): Action => ({
        name,
        text: name[0].toUpperCase() + name.slice(1),
        key,
        title: `draw ${name === 'surface' ? 'the surface between passes' : name === 'lines' ? 'the tool path as lines' : 'the points only'}`,
        group: 'Draw',
        run: () => store.set({ style: name }),
        pressed: () => state.style === name,
    });
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
    const point = (by: number) => () => {
        const vertex = Math.min(view.surface.count - 1, Math.max(0, (state.vertex ?? 0) + by));
        store.set({ vertex, line: view.surface.line[vertex], defect: null, pass: 0 });
    };
    const actions: Action[] = [
        look('iso', 'Iso', 'i'),
        look('top', 'Top', 't'),
        look('front', 'Front', 'f'),
        look('left', 'Left', 'l'),
        { name: 'fit', text: 'Fit', key: 'h', title: 'show the whole part', group: 'View', run: () => view.fit() },
        style('surface', 's'),
        style('lines', 'n'),
        style('points', 'o'),
        tool('box', 'Box zoom', 'b', 'drag a box to zoom to it'),
        tool('measure', 'Measure', 'm', 'click two places to measure their distance'),
        {
            name: 'defects',
            text: 'Outlines',
            key: 'u',
            title: 'outline the defects',
            group: 'Defects',
            run: () => store.set({ defects: !state.defects }),
            pressed: () => state.defects,
        },
        {
            name: 'previous-defect',
            text: '◀',
            key: 'v',
            title: 'the previous defect',
            group: 'Defects',
            run: () => handlers.stepDefect(-1),
        },
        {
            name: 'next-defect',
            text: 'Defect ▶',
            key: 'd',
            title: 'the next defect, the worst first',
            group: 'Defects',
            run: () => handlers.stepDefect(1),
        },
        { name: 'point-before', text: '', key: ',', title: 'the previous point', group: 'Cursor', run: point(-1) },
        { name: 'point-after', text: '', key: '.', title: 'the next point', group: 'Cursor', run: point(1) },
        {
            name: 'play',
            text: '',
            key: 'a',
            title: 'play and pause the motion of the tool',
            group: 'Cursor',
            run: handlers.play,
        },
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
        {
            name: 'next-map',
            text: '',
            key: 'k',
            title: 'the next colour map',
            group: 'Colours',
            run: () => view.classes === null && store.set({ map: maps[(maps.indexOf(state.map) + 1) % maps.length] }),
        },
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
    if (logs > 1) {
        const left = { vertex: null, hover: null, pass: 0, defect: null }; // numbers of points are those of a log
        const shown = (name: 'before' | 'after' | 'wipe' | 'difference', key: string, title: string): Action => ({
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
        actions.push(
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
                run: () =>
                    store.set({
                        shown: state.shown === 'before' ? 'after' : 'before',
                        vertex: null,
                        hover: null,
                        pass: 0,
                        defect: null,
                    }),
            },
        );
    }
    return actions;
}
