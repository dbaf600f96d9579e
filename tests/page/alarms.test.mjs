// Bars across the page where the data prove nothing: the wrong program, a log that was cut off, too little compared.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';

import { bottle, closeReport, data, folder, openReport, reports, run, startBrowser, writeReport } from './browser.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser?.close());

const bars = (page) => page.$$eval('.alarm', (all) => all.map((bar) => bar.textContent));
const colour = (page, selector) => page.$eval(selector, (e) => getComputedStyle(e).backgroundColor);

test('a sound log has none', async () => {
    const page = await openReport(browser, reports.bottle);
    assert.deepEqual(await bars(page), []);
    assert.equal(await colour(page, '.tree .severity'), 'rgb(179, 71, 0)');
    await closeReport(page);
});

test('the wrong program is said in red, and what was found is grey', async () => {
    const wrong = { program: `${data}/programs/dome_loops.nc`, log: bottle.log };
    const page = await openReport(browser, writeReport('wrong.html', wrong, '--force', '--tool', 'none'));
    const [bar, ...more] = await bars(page);
    assert.deepEqual(more, []);
    assert.match(bar, /^Not judged\. The log does not belong to this program/);
    assert.equal(await colour(page, '.alarm'), 'rgb(179, 38, 30)');
    for (const badge of await page.$$('.severity'))
        assert.equal(await badge.evaluate((e) => getComputedStyle(e).backgroundColor), 'rgb(107, 114, 128)');
    assert.ok((await page.locator('.severity').count()) > 0);
    const room = await page.evaluate(() => {
        const [toolbar, alarm] = ['.toolbar', '.alarm'].map((name) => document.querySelector(name));
        const { left, right } = alarm.getBoundingClientRect();
        return { cut: toolbar.scrollHeight - toolbar.clientHeight, left, right, width: innerWidth };
    });
    assert.deepEqual(room, { cut: 0, left: 0, right: 1280, width: 1280 });
    await closeReport(page);
});

test('a log that was cut off is said', async () => {
    const whole = fs.readFileSync(bottle.log);
    const cut = path.join(folder, 'cut.biip');
    fs.writeFileSync(cut, whole.subarray(0, Math.round(0.7 * whole.length)));
    const page = await openReport(browser, writeReport('cut.html', { ...bottle, log: cut }, '--tool', 'none'));
    const [bar] = await bars(page);
    assert.match(bar, /^The log is cut off\. .* lacks (2\d|3\d) % of the program's motions/);
    await closeReport(page);
});

test('too little that could be compared is said', async () => {
    // Passes of half a millimetre are all ends: nothing is compared.
    const lines = ['G21 G90 G54', 'G0 X0 Y0 Z5', 'G1 Z0 F600'];
    for (let pass = 0; pass < 40; pass += 2)
        lines.push(`G1 Y${(pass / 5).toFixed(1)}`, 'X0.5', `Y${((pass + 1) / 5).toFixed(1)}`, 'X0');
    const short = { program: path.join(folder, 'short.nc'), log: path.join(folder, 'short.biip') };
    fs.writeFileSync(short.program, [...lines, 'M30', ''].join('\n'));
    run('simulate', short.program, '-o', short.log);
    const page = await openReport(browser, writeReport('short.html', short));
    assert.match((await bars(page))[0], /^Not judged\. Only 0\.0 %/);
    await closeReport(page);
});

test('the header names the machine of a simulated log, and says that it was simulated', async () => {
    const part = { program: bottle.program, log: path.join(folder, 'simulated.biip') };
    run('simulate', part.program, '-o', part.log);
    const [, machine] = /simulated for the machine "(.+)"/.exec(run('check', part.program, part.log, '--tool', 'none'));
    const page = await openReport(
        browser,
        writeReport('simulated.html', part, '--before', bottle.log, '--tool', 'none'),
    );
    const facts = await page.$$eval('#summary dl > div', (all) => all.map((fact) => fact.textContent));
    assert.ok(facts.includes(`Machine${machine} simulated; before: recorded`), facts.join('\n'));
    assert.match(await page.textContent('#health'), /simulated for the machine/);
    await closeReport(page);
});
