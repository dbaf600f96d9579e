// The programmed path under the log: a node of the tree shows and hides it.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

import { bottle, countPixels, folder, goTo, numbers, run, settled, useReport, writeReport } from './browser.mjs';

let page;
useReport(
    () => writeReport('bottle.html', bottle),
    (opened) => (page = opened),
);

/** Pixels of the map that are as dark as the lines. */
async function darkPixels() {
    await settled(page);
    return countPixels(page, page.locator('.layer').first(), (r, g, b) => r < 90 && g < 90 && b < 90);
}

test('the node draws thin lines over the surface, and takes them away again', async () => {
    await page.click('[data-action="top"]');
    const node = page.locator('[data-choice="programmed"]');
    assert.equal(await node.getAttribute('aria-pressed'), 'false');
    const before = await darkPixels();
    await node.click();
    assert.equal(await node.getAttribute('aria-pressed'), 'true');
    const lines = await darkPixels();
    assert.ok(lines > before + 3000, `${lines} dark pixels, ${before} before`);
    await node.click();
    assert.ok(Math.abs((await darkPixels()) - before) < 200);
});

test('length, turn and feed of the block are among the values of a point', async () => {
    await goTo(page, 'point', 4848);
    const shown = await numbers(page);
    const csv = path.join(folder, 'blocks.csv');
    const columns = ['block_length', 'turning_angle', 'programmed_feed'];
    run('export', bottle.program, bottle.log, '-o', csv, '--columns', columns.join(','), '-q');
    const expected = fs.readFileSync(csv, 'utf8').trimEnd().split('\n')[1 + 4848].split(',').map(Number);
    ['Length of the block', 'Angle between blocks', 'Programmed feed'].forEach((name, k) =>
        assert.ok(
            Math.abs(Number(shown[name]) - expected[k]) <= 1e-3 * (1 + Math.abs(expected[k])),
            `${name}: ${shown[name]}, not ${expected[k]}`,
        ),
    );
});
