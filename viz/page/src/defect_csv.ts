// Defects as CSV (RFC 4180): one row each, names with their units.

import type { Opinions } from './accepted';
import type { Defect } from './manifest';

export interface Column {
    head: string;
    value: (defect: Defect) => number | string | null; // that is sorted by
    text?: (defect: Defect) => string; // if it is not the value
}

function linesOf(defect: Defect): string {
    return defect.runs.map(({ lines: [first, last] }) => (first === last ? `${first}` : `${first}-${last}`)).join(' ');
}

/** To as many digits as mean something. */
const rounded = (value: number | null | undefined) =>
    value === null || value === undefined ? null : Number(value.toFixed(2));

const columns: Column[] = [
    { head: 'rank', value: (d) => d.id },
    { head: 'severity', value: (d) => d.severity },
    { head: 'severity_name', value: (d) => d.severity_name },
    { head: 'cause', value: (d) => d.cause },
    { head: 'finding', value: (d) => d.text },
    { head: 'score', value: (d) => rounded(d.score) },
    { head: 'depth_um', value: (d) => rounded(d.depth_um) },
    { head: 'shape', value: (d) => d.shape },
    { head: 'formed_um', value: (d) => rounded(d.formed_um) },
    { head: 'speed_percent', value: (d) => rounded(d.speed_percent) },
    { head: 'length_mm', value: (d) => rounded(d.length_mm) },
    { head: 'x_mm', value: (d) => d.position_mm[0] },
    { head: 'y_mm', value: (d) => d.position_mm[1] },
    { head: 'z_mm', value: (d) => d.position_mm[2] },
    { head: 'passes', value: (d) => [...new Set(d.runs.map((run) => run.pass))].join(' ') },
    { head: 'lines', value: linesOf },
];

function cell(value: number | string | null): string {
    const text = value === null ? '' : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function defectsCsv(defects: Defect[], opinions: Opinions): string {
    const all: Column[] = [
        ...columns,
        { head: 'accepted', value: (d) => String(opinions.get(d.id)?.accepted === true) },
        { head: 'comment', value: (d) => opinions.get(d.id)?.comment ?? '' },
    ];
    const rows = [all.map((c) => c.head), ...defects.map((d) => all.map((c) => cell(c.value(d))))];
    return rows.map((row) => `${row.join(',')}\r\n`).join('');
}
