// The page of `clsurf report`: reads its data, puts the panes together, links them.

import 'uplot/dist/uPlot.min.css';
import './style.css';

import { firstOpinions } from './accepted';
import { actionsOf, type Action } from './actions';
import { ColourMap } from './colour';
import { readBytes } from './columns';
import { renderCommand } from './command';
import { CurvesPane, secondCurve } from './curves_pane';
import { DefectCard } from './defect_card';
import { printDefect } from './defect_print';
import { DefectList } from './defect_list';
import { showCommand, showKeys } from './dialogs';
import { baseName, element, saveFile } from './dom';
import { everyDefect } from './filters';
import { readHeightMap, type HeightMap } from './height_map';
import { readManifest, type Manifest } from './manifest';
import { defectOfLink, Navigation } from './navigation';
import { ProgramPane } from './program_pane';
import { ProgramText } from './program_text';
import { Player } from './player';
import { readProgrammed, type ProgrammedPath } from './programmed';
import { rememberKeys, rememberedKeys } from './preferences';
import { RangePane } from './range_pane';
import { RecordsPane } from './records_pane';
import { Store, type State } from './store';
import { readSurface, type Surface } from './surface';
import { TablePane } from './table_pane';
import { Toolbar } from './toolbar';
import { TreePane } from './tree_pane';
import { everyKind, ViewPane } from './view_pane';

const signedMap = 'coolwarm'; // of deviations and differences
const system = matchMedia('(prefers-color-scheme: dark)');
const setTheme = (theme: 'light' | 'dark') => (document.documentElement.dataset.theme = theme);
const dark = () => document.documentElement.dataset.theme === 'dark';

/** What the page shows, read from its data. */
interface PageData {
    manifest: Manifest;
    surfaces: Surface[];
    text: ProgramText;
    heightMap: HeightMap | null;
    programmed: ProgrammedPath | null;
    maps: ColourMap[];
}

async function readPage(): Promise<PageData> {
    const manifest = readManifest();
    const surfaces = [];
    for (let k = 0; k < manifest.surfaces.length; ++k) surfaces.push(await readSurface(manifest, k));
    const text = new ProgramText(await readBytes(manifest.program.text), manifest.program.lines);
    const heightMap = manifest.relief ? await readHeightMap(manifest.relief, manifest.surfaces[0].origin_mm) : null;
    const programmed = manifest.programmed
        ? await readProgrammed(manifest.programmed, manifest.surfaces[0].origin_mm)
        : null;
    return { manifest, surfaces, text, heightMap, programmed, maps: manifest.colour_maps.map((i) => new ColourMap(i)) };
}

function initialState(manifest: Manifest): State {
    const first = Math.max(
        0,
        manifest.fields.findIndex((f) => f.name === manifest.first_field),
    );
    return {
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
    };
}

/** Theme, keys and colour map follow from the state. */
function followState(manifest: Manifest, store: Store): void {
    let usual = store.state.map;
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
}

interface Panes {
    toolbar: Toolbar;
    range: RangePane;
    curves: CurvesPane;
    records: RecordsPane;
    tree: TreePane;
    program: ProgramPane;
    table: TablePane;
    player: Player;
    card: DefectCard;
    actions: Action[];
}

function buildPanes(data: PageData, store: Store, view: ViewPane, navigation: Navigation): Panes {
    const { manifest, surfaces, text } = data;
    const surface = () => view.surface;
    const { goToDefect, goToGone, stepDefect, locate } = navigation;
    const savePicture = async () => saveFile(`${baseName(manifest.program.name)}.png`, await view.picture());
    const actions: Action[] = actionsOf(
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
        data.maps.map((m) => m.name),
    );
    const toolbar = new Toolbar(manifest, store, actions, locate);
    const range = new RangePane(store, view);
    const curves = new CurvesPane(manifest, store, surfaces, surface);
    const records = new RecordsPane(manifest, store, surface);
    const tree = new TreePane(manifest, store, surface, { goToDefect, goToGone }, data.heightMap !== null);
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
    return { toolbar, range, curves, records, tree, program, table, player, card, actions };
}

function putTogether(app: HTMLElement, panes: Panes, view: ViewPane): void {
    app.append(
        panes.toolbar.element,
        element('div', { class: 'side' }, panes.range.element, panes.tree.element),
        view.element,
        panes.card.element,
        panes.player.element,
        panes.program.element,
        panes.curves.element,
        panes.records.element,
        panes.table.element,
    );
    app.hidden = false;
}

/** The heights that the style sheet leaves room for. */
function publishHeights(card: HTMLElement): void {
    const summary = document.getElementById('summary');
    const setHeight = () => document.documentElement.style.setProperty('--summary', `${summary?.offsetHeight ?? 0}px`);
    if (summary) new ResizeObserver(setHeight).observe(summary);
    setHeight();
    const setCard = () => document.documentElement.style.setProperty('--card', `${card.offsetHeight}px`);
    new ResizeObserver(setCard).observe(card);
}

function bindKeys(store: Store, actions: Action[]): void {
    document.addEventListener('keydown', (event) => {
        const target = event.target as HTMLElement;
        if (!store.state.keys && event.key.length === 1) return;
        if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input, textarea, select, dialog')) return;
        const action = actions.find((a) => a.key === event.key.toLowerCase());
        if (!action) return;
        event.preventDefault();
        action.run();
    });
}

/** The list below the view, and the part of the address behind "#". */
function bindDefects(app: HTMLElement, manifest: Manifest, store: Store, goToDefect: (index: number) => void): void {
    const list = document.getElementById('defect-list');
    if (list)
        new DefectList(list, manifest, store, (index) => {
            app.scrollIntoView();
            goToDefect(index);
        });
    const follow = () => {
        const index = defectOfLink(location.hash, manifest.defects.length);
        if (index !== null) goToDefect(index);
    };
    follow();
    addEventListener('hashchange', follow);
}

async function begin(app: HTMLElement): Promise<void> {
    const data = await readPage();
    const { manifest } = data;
    const store = new Store(initialState(manifest));
    followState(manifest, store);
    const view = new ViewPane(manifest, store, data.surfaces, data.maps, data.heightMap, data.programmed);
    const navigation = new Navigation(manifest, store, data.text, view);
    view.showDefect = navigation.goToDefect;
    const panes = buildPanes(data, store, view, navigation);
    navigation.showCard = () => panes.card.reveal(view.element);
    putTogether(app, panes, view);
    publishHeights(panes.card.element);
    view.begin();
    panes.range.begin();
    panes.curves.build();
    store.on((state, changed) => {
        if (changed.has('vertex') && state.vertex !== null && state.defect === null && !state.playing)
            view.reveal(state.vertex);
    });
    bindKeys(store, panes.actions);
    bindDefects(app, manifest, store, navigation.goToDefect);
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
