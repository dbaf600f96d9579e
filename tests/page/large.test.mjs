// Many points: all of them where they fit, and what is kept where they do not.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';

import {
    chosenLine,
    closeReport,
    folder,
    goTo,
    numbers,
    openReport,
    run,
    startBrowser,
    writeReport,
} from './browser.mjs';

const part = { program: path.join(folder, 'many.nc'), log: path.join(folder, 'many.biip') };

let browser;
before(async () => {
    execFileSync(process.env.MAKE_SAMPLE, ['zigzag', '300000', part.program, part.log]);
    browser = await startBrowser();
});
after(async () => {
    await browser.close();
    for (const file of Object.values(part)) fs.rmSync(file, { force: true });
});

const query = (...words) => JSON.parse(run('query', part.program, part.log, '--json', '-q', ...words)).matches;

test('three hundred thousand points are all there', async () => {
    const file = writeReport('whole.html', part);
    assert.ok(fs.statSync(file).size < 6e6);
    const page = await openReport(browser, file);
    assert.match(await page.locator('#contents').innerText(), /all 300\u202f000 points are in this page/);
    await goTo(page, 'point', 265_432);
    const [match] = query('--point', '265432');
    assert.equal(Number((await numbers(page)).Point), 265_432);
    assert.equal(await chosenLine(page), match.line);
    await closeReport(page);
    fs.rmSync(file);
});

test('a small page keeps what it says it keeps, and says what it leaves out', async () => {
    const file = writeReport('small.html', part, '--max-size', '3.6');
    assert.ok(fs.statSync(file).size <= 3.6e6, `${fs.statSync(file).size} bytes`);
    const page = await openReport(browser, file);
    assert.match(
        await page.locator('#contents').innerText(),
        /of 300\u202f000 points are in this page. Of each [\d\u202f]+ consecutive points/,
    );
    // The first point of a line is there, where the page says that all are.
    const starts = /first point of each line/.test(await page.locator('#contents').innerText());
    if (starts) {
        await goTo(page, 'line', 12_000);
        assert.equal(Number((await numbers(page)).Point), query('--line', '12000')[0].point);
    }
    // So are the reasons of what is slow, of the points that are kept.
    await goTo(page, 'point', 123_456);
    const kept = await numbers(page);
    const reasons = query('--point', kept.Point)[0].slow_because ?? [];
    assert.equal(kept.Slow.replace(/^.*?: /, ''), reasons.join('; ') || 'no');
    // The place where a defect is strongest is there.
    const { defects } = JSON.parse(run('check', part.program, part.log, '--json', '-q'));
    for (const k of [0, defects.length - 1]) {
        await page.click(`[data-choice="defect-${k}"]`);
        assert.equal(Number((await numbers(page)).Point), defects[k].point);
    }
    await closeReport(page);
    fs.rmSync(file);
});
