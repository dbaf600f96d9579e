// The list of records: what the log says of each point, linked to the rest of the page, and no more rows than are seen.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

import { bottle, chosenLine, folder, goTo, numbers, press, run, settled, useReport, writeReport } from './browser.mjs';

let page;
useReport(
    () => writeReport('bottle.html', bottle),
    (opened) => (page = opened),
);

const titles = () => page.$$eval('.records .head [role="columnheader"]', (all) => all.map((one) => one.title));
const row = async (point) => {
    const cells = await page.$$eval(`.records .rows .row[data-vertex="${point}"] [role="cell"]`, (all) =>
        all.map((cell) => cell.textContent),
    );
    return Object.fromEntries((await titles()).map((title, k) => [title, cells[k]]));
};

test('the records stand in place of the curves, and have the numbers of the log', async () => {
    await goTo(page, 'point', 4848);
    assert.equal(await page.locator('.records').isVisible(), false);
    await press(page, 'j');
    assert.equal(await page.locator('.records').isVisible(), true);
    assert.equal(await page.locator('.curves').isVisible(), false);
    const csv = path.join(folder, 'records.csv');
    const columns = ['cmd.x', 'cmd.z', 'fb.y', 'speed', 'speed.x', 'acceleration.z', 'line'];
    run('export', bottle.program, bottle.log, '-o', csv, '--columns', columns.join(','), '-q');
    const lines = fs.readFileSync(csv, 'utf8').trimEnd().split('\n');
    const expected = lines[1 + 4848].split(',').map(Number);
    const shown = await row(4848);
    const names = [
        'X commanded [mm]',
        'Z commanded [mm]',
        'Y feedback [mm]',
        'Path speed [mm/min]',
        'Speed of X [mm/min]',
        'Acceleration of Z [mm/s²]',
        'Line',
    ];
    names.forEach((name, k) => {
        assert.ok(name in shown, `${name} is not among ${Object.keys(shown)}`);
        const most = 1e-4 + 2e-3 * Math.abs(expected[k]);
        assert.ok(Math.abs(Number(shown[name]) - expected[k]) <= most, `${name}: ${shown[name]}, not ${expected[k]}`);
    });
});

test('only rows that are seen exist, wherever the list stands', async () => {
    for (const share of [0, 0.37, 1]) {
        await page.$eval('.records', (list, at) => (list.scrollTop = at * list.scrollHeight), share);
        await settled(page);
        const rows = await page.$$eval('.records .rows .row', (all) => all.map((one) => Number(one.dataset.vertex)));
        assert.ok(rows.length > 5 && rows.length < 40, `${rows.length} rows`);
        rows.forEach((vertex, k) => assert.equal(vertex, rows[0] + k));
    }
    const last = await page.$$eval('.records .rows .row', (all) => Number(all.at(-1).dataset.vertex));
    assert.equal(last, 27516, 'the end of the list is the end of the log');
});

test('a row leads to its place, and arrow keys to the next one', async () => {
    await goTo(page, 'point', 9000);
    await page.click('.records .rows .row[data-vertex="9003"]');
    const shown = await numbers(page);
    assert.equal(Number(shown.Point), 9003);
    assert.equal(await chosenLine(page), Number(shown.Line));
    await page.press('.records', 'ArrowDown');
    assert.equal(Number((await numbers(page)).Point), 9004);
    assert.equal(await page.getAttribute('.records .row.chosen', 'data-vertex'), '9004');
});

test('the curves come back', async () => {
    await press(page, 'j');
    assert.equal(await page.locator('.curves').isVisible(), true);
    assert.equal(await page.locator('.records').isVisible(), false);
});
