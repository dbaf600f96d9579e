import type { Rgb } from './colour';
// What io/page/page_data.cpp writes: the names are the same there.

export interface PackedColumn {
    block: number;
    count: number;
    order: number;
    stride: number;
    planes: number;
}

export interface FieldInfo {
    name: string;
    label: string;
    unit: string;
    map: string; // the colour map that suits it
    slack: number; // beyond an end that still has the end's colour
    classes: boolean; // its values are names: it has no range
    same_classes: boolean; // every log has the same ones
    note: string;
    low: number;
    high: number;
    lowest: number;
    highest: number;
    range_note: string;
}

/** A class of a field whose values are names. */
export interface ClassInfo {
    name: string;
    step: number; // its value in quanta of the field
    rgb: Rgb;
    share: number; // of the cutting points of the log
}

export interface ColourMapInfo {
    name: string;
    summary: string;
    centred: boolean;
    rgb: string;
    below: Rgb; // of values outside the range
    above: Rgb;
}

export interface DefectRun {
    pass: number;
    points: [number, number];
    lines: [number, number];
}

export interface Defect {
    id: number;
    fingerprint: string; // the same from run to run
    accepted?: boolean; // when the report was written
    comment?: string;
    severity: number;
    severity_name: string;
    cause: string;
    quantity: 'speed' | 'acceleration' | 'lag' | 'relief'; // that shows it best
    normal?: [number, number, number]; // of the surface, there
    text: string;
    position_mm: [number, number, number]; // on the part where the tool is known
    tip_mm: [number, number, number];
    contact_mm?: [number, number, number];
    contact_outlines?: number[][]; // as outlines, on the part
    bounds_mm: [[number, number, number], [number, number, number]];
    depth_um: number | null; // without a sign: `shape` is pit, bulge, alternating or none
    score: number; // times the threshold
    speed_percent: number | null;
    length_mm: number | null;
    formed_um?: number | null; // in the as-machined surface, where the tool is known
    shape: string;
    change?: 'new' | 'remaining'; // against the log before
    id_before?: number; // of a remaining one
    point: number;
    runs: DefectRun[];
    neighbours: DefectRun[];
    outlines: number[][]; // x, y, z of the corners of open lines: pieces of its border
}

/** Why the tool is slow: pieces of text, one a line, and for each vertex which of them are joined. */
export interface SlowInfo {
    speed: PackedColumn; // [mm/min] before the pieces
    pieces: PackedColumn;
    columns: PackedColumn[];
}

export interface SurfaceInfo {
    log: string;
    role: string;
    records: number;
    period_s: number;
    step_over_mm: number;
    origin_mm: [number, number, number];
    position_quantum_mm: number;
    time_quantum_s: number;
    points: number;
    window: number;
    line_starts: boolean;
    pass_count: number;
    columns: {
        point: PackedColumn;
        run_points: PackedColumn;
        run_lines: PackedColumn;
        kind: PackedColumn;
        triangles: PackedColumn;
        segments: PackedColumn;
        time?: PackedColumn;
        x: PackedColumn;
        y: PackedColumn;
        z: PackedColumn;
        passes: PackedColumn;
        before?: PackedColumn; // place on the log before, in sixteenths of a step, from 1; 0: none
    };
    slow?: SlowInfo; // where the tool is slow anywhere
    roles: { name: string; x: PackedColumn; y: PackedColumn; z: PackedColumn }[];
    fields: {
        name: string;
        quantum: number;
        values: PackedColumn;
        missing?: PackedColumn;
        classes?: ClassInfo[];
        ramps?: PackedColumn; // first and last points of what is drawn in a lighter tone: all passes have it
    }[];
}

export interface HeightMapInfo {
    origin_mm: [number, number, number];
    pitch_mm: number;
    columns: number;
    rows: number;
    z_quantum_mm: number;
    deviation_quantum_um: number;
    low: number;
    high: number;
    lowest: number;
    highest: number;
    note: string;
    z: PackedColumn;
    deviation: PackedColumn;
    missing: PackedColumn;
}

/** The path as it is programmed. */
export interface ProgrammedInfo {
    quantum_mm: number;
    x: PackedColumn;
    y: PackedColumn;
    z: PackedColumn;
    begin: PackedColumn; // per corner: 1 where no line leads to it
}

/** A defect of the log before that is gone. */
export interface GoneDefect {
    id: number; // in the report of the log before
    severity: number;
    severity_name: string;
    cause: string;
    text: string;
    tip_mm: [number, number, number];
    bounds_mm: Defect['bounds_mm'];
    point: number; // of the log before
}

export interface ToolInfo {
    text: string; // "ball:6"
    radius_mm: number;
    corner_mm: number; // of its edge: the radius of a ball, 0 of a flat one
    upright: boolean; // its axis is Z all the way
}

export interface Manifest {
    version: number;
    judged: boolean; // false: what was found proves nothing
    tool?: ToolInfo;
    program: { name: string; lines: number; text: PackedColumn };
    command: { program: string; log: string; before: string; options: string[]; formed: string[] };
    work_system: string; // that positions count in, "G54"; empty: several, or not known
    first_field: string;
    colour_maps: ColourMapInfo[];
    fields: FieldInfo[];
    defects: Defect[];
    gone: GoneDefect[];
    surfaces: SurfaceInfo[];
    relief?: HeightMapInfo; // of the as-machined surface
    programmed?: ProgrammedInfo;
}

export function readManifest(): Manifest {
    const element = document.getElementById('manifest');
    if (!element) throw new Error('the page has no manifest');
    return JSON.parse(element.textContent ?? '') as Manifest;
}
