// The page of `clsurf report`: reads its data, puts the panes together, links them.

import 'uplot/dist/uPlot.min.css';
import './style.css';

import { firstOpinions } from './accepted';
import { actionsOf } from './actions';
import { ColourMap } from './colour';
import { readBytes } from './columns';
import { renderCommand } from './command';
import { CurvesPane, secondCurve } from './curves_pane';
import { DefectCard } from './defect_card';
import { printDefect } from './defect_print';
import { DefectList } from './defect_list';
import { showCommand, showKeys } from './dialogs';
import { baseName, element, saveFile } from './dom';
import { everyDefect, keeps } from './filters';
import { readManifest, type Defect, type Manifest } from './manifest';
import { ProgramPane } from './program_pane';
import { ProgramText } from './program_text';
import { Player } from './player';
import { readProgrammed } from './programmed';
import { rememberKeys, rememberedKeys } from './preferences';
import { RangePane } from './range_pane';
import { RecordsPane } from './records_pane';
import { readRelief } from './relief';
import { Store } from './store';
import { readSurface } from './surface';
import { TablePane } from './table_pane';
import { Toolbar } from './toolbar';
import { TreePane } from './tree_pane';
import { everyKind, ViewPane } from './view_pane';

const signedMap = 'coolwarm'; // of deviations and differences
const system = matchMedia('(prefers-color-scheme: dark)');
const setTheme = (theme: 'light' | 'dark') => (document.documentElement.dataset.theme = theme);
const dark = () => document.documentElement.dataset.theme === 'dark';

/** "#defect-10" is the tenth one. */
const defectLink = (index: number) => `#defect-${index + 1}`;
function defectOfLink(hash: string, count: number): number | null {
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

async function begin(app: HTMLElement): Promise<void> {
    const manifest = readManifest();
    const surfaces = [];
    for (let k = 0; k < manifest.surfaces.length; ++k) surfaces.push(await readSurface(manifest, k));
    const text = new ProgramText(await readBytes(manifest.program.text), manifest.program.lines);
    const relief = manifest.relief ? await readRelief(manifest.relief, manifest.surfaces[0].origin_mm) : null;
    const programmed = manifest.programmed
        ? await readProgrammed(manifest.programmed, manifest.surfaces[0].origin_mm)
        : null;
    const maps = manifest.colour_maps.map((info) => new ColourMap(info));

    const first = Math.max(
        0,
        manifest.fields.findIndex((f) => f.name === manifest.first_field),
    );
    const store = new Store({
        field: first,
        map: manifest.fields[first].map,
        bins: 0,
        low: manifest.fields[first].low,
        high: manifest.fields[first].high,
        style: 'surface',
        role: 0,
        formed: false,
        defects: false,
        programmed: false,
        shown: 'after',
        playing: false,
        time: null,
        wipe: 0.5,
        vertex: null,
        hover: null,
        line: 0,
        pass: 0,
        defect: null,
        pinned: null,
        accepted: firstOpinions(manifest),
        filter: everyDefect,
        kinds: everyKind,
        passes: null,
        tool: 'turn',
        over: 'time',
        curves: [first, secondCurve(manifest, first)],
        records: false,
        theme: dark() ? 'dark' : 'light',
        keys: rememberedKeys(),
    });
    let usual = manifest.fields[first].map;
    store.on((state, changed) => {
        if (changed.has('theme')) setTheme(state.theme);
        if (changed.has('keys')) rememberKeys(state.keys);
        // Each field has the map that suits it, unless another was chosen.
        if (changed.has('field') || changed.has('formed') || changed.has('shown')) {
            const signed = state.formed || state.shown === 'difference';
            const next = signed ? signedMap : manifest.fields[state.field].map;
            const chosen = state.map !== usual;
            usual = next;
            if (!chosen && state.map !== next) store.set({ map: next });
        }
    });
    system.addEventListener('change', () => store.set({ theme: system.matches ? 'dark' : 'light' }));

    const view = new ViewPane(manifest, store, surfaces, maps, relief, programmed);
    const surface = () => view.surface;
    const goToDefect = (index: number) => {
        const defect = manifest.defects[index];
        if (store.state.shown === 'before') store.set({ shown: 'after' });
        const vertex = surface().vertexOfPoint(defect.point);
        const origin = manifest.surfaces[0].origin_mm;
        // The numbers are those of the defect until the pointer moves.
        store.set({ defect: index, pinned: index, vertex, hover: null, line: surface().line[vertex], pass: 0 });
        const field = fieldOfQuantity(manifest, defect.quantity);
        if (field !== null && (field !== store.state.field || store.state.formed)) store.set({ field, formed: false });
        if (defect.normal) view.lookAlong(defect.normal);
        history.replaceState(null, '', defectLink(index));
        view.goTo(
            defect.bounds_mm[0].map((c, k) => c - origin[k]),
            defect.bounds_mm[1].map((c, k) => c - origin[k]),
        );
        card.reveal(view.element);
    };
    view.showDefect = goToDefect;
    const goToGone = (index: number) => {
        const gone = manifest.gone[index];
        const origin = manifest.surfaces[0].origin_mm;
        store.set({ shown: 'before', formed: false, defect: null, pinned: null, pass: 0 });
        const vertex = surface().vertexOfPoint(gone.point);
        store.set({ vertex, hover: null, line: surface().line[vertex] });
        view.goTo(
            gone.bounds_mm[0].map((c, k) => c - origin[k]),
            gone.bounds_mm[1].map((c, k) => c - origin[k]),
        );
    };
    const stepDefect = (by: number) => {
        const kept = manifest.defects.map((_, k) => k).filter((k) => keeps(store.state, manifest.defects[k]));
        if (kept.length === 0) return;
        const at = kept.indexOf(store.state.defect ?? store.state.pinned ?? -1);
        goToDefect(kept[at < 0 ? (by > 0 ? 0 : kept.length - 1) : (at + by + kept.length) % kept.length]);
    };
    const locate = (kind: string, value: number): string | null => {
        const s = surface();
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
    const savePicture = async () => saveFile(`${baseName(manifest.program.name)}.png`, await view.picture());
    const actions = actionsOf(
        store,
        view,
        {
            savePicture: () => void savePicture(),
            showCommand: () =>
                showCommand(renderCommand(manifest, store.state, view.camera, surface(), view.extent(), dark())),
            play: () => player.toggle(),
            showHelp: () => showKeys(actions, store),
            locate: () => toolbar.locator.input.focus(),
            stepDefect,
        },
        surfaces.length,
        surfaces[0].before !== null,
        maps.map((m) => m.name),
    );
    const toolbar = new Toolbar(manifest, store, actions, locate);
    const range = new RangePane(store, view);
    const curves = new CurvesPane(manifest, store, surfaces, surface);
    const records = new RecordsPane(manifest, store, surface);
    const tree = new TreePane(manifest, store, surface, { goToDefect, goToGone }, relief !== null);
    const program = new ProgramPane(manifest, text, store, surface);
    const table = new TablePane(manifest, text, store, surface);
    const player = new Player(store, surface);
    const printCard = async (index: number) => {
        const defect = manifest.defects[index];
        const comment = store.state.accepted.get(defect.id)?.comment ?? '';
        await printDefect(manifest, text, defect, comment, await view.picture());
    };
    const card = new DefectCard(manifest, store, {
        step: stepDefect,
        goToLine: (line) => void locate('line', line),
        goToDefect,
        print: (index) => void printCard(index),
    });
    app.append(
        toolbar.element,
        element('div', { class: 'side' }, range.element, tree.element),
        view.element,
        card.element,
        player.element,
        program.element,
        curves.element,
        records.element,
        table.element,
    );
    app.hidden = false;
    const summary = document.getElementById('summary');
    const setHeight = () => document.documentElement.style.setProperty('--summary', `${summary?.offsetHeight ?? 0}px`);
    if (summary) new ResizeObserver(setHeight).observe(summary);
    setHeight();
    const setCard = () => document.documentElement.style.setProperty('--card', `${card.element.offsetHeight}px`);
    new ResizeObserver(setCard).observe(card.element);
    view.begin();
    range.begin();
    curves.build();
    store.on((state, changed) => {
        if (changed.has('vertex') && state.vertex !== null && state.defect === null && !state.playing)
            view.reveal(state.vertex);
    });

    document.addEventListener('keydown', (event) => {
        const target = event.target as HTMLElement;
        if (!store.state.keys && event.key.length === 1) return;
        if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input, textarea, select, dialog')) return;
        const action = actions.find((a) => a.key === event.key.toLowerCase());
        if (!action) return;
        event.preventDefault();
        action.run();
    });
    const list = document.getElementById('defect-list');
    if (list)
        new DefectList(list, manifest, store, (index) => {
            app.scrollIntoView();
            goToDefect(index);
        });
    const linked = defectOfLink(location.hash, manifest.defects.length);
    if (linked !== null) goToDefect(linked);
    addEventListener('hashchange', () => {
        const index = defectOfLink(location.hash, manifest.defects.length);
        if (index !== null) goToDefect(index);
    });
    document.documentElement.dataset.ready = 'yes';
}

const app = document.getElementById('app');
setTheme(system.matches ? 'dark' : 'light');
if (app) {
    begin(app).catch((error: unknown) => {
        app.hidden = false;
        app.className = 'failed';
        app.textContent = `The view is not available: ${error instanceof Error ? error.message : String(error)}. The pictures and tables below are complete.`;
        console.error(error);
    });
}
