// Before and after: one scale, toggle and wipe.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';

import {
    clsurf,
    comparePicture,
    data,
    goTo,
    logs,
    numbers,
    press,
    pressed,
    settled,
    useReport,
    writeReport,
} from './browser.mjs';

// The same program's log with its ninth loop left out stands for the run before.
const part = { program: `${data}/programs/dome_loops.nc`, log: `${logs}/dome_loops.biip` };
const older = process.env.LOG_BEFORE;

let page;
useReport(
    () => writeReport('compare.html', part, '--before', older),
    (opened) => (page = opened),
);

const layers = () => page.$$eval('.layer', (all) => all.map((l) => l.style.visibility));

test('after is shown first; keys and buttons change to before, wipe and back', async () => {
    assert.deepEqual(await layers(), ['visible', 'hidden']);
    for (const [key, name, shown] of [
        ['1', 'before', ['hidden', 'visible']],
        ['w', 'wipe', ['visible', 'visible']],
        ['2', 'after', ['visible', 'hidden']],
    ]) {
        await press(page, key);
        assert.ok(await pressed(page, name));
        assert.deepEqual(await layers(), shown);
        await page.click(`[data-action="${name === 'after' ? 'before' : 'after'}"]`);
        await page.click(`[data-action="${name}"]`);
        assert.deepEqual(await layers(), shown);
    }
    await press(page, 'c');
    assert.ok(await pressed(page, 'before'));
    await press(page, 'c');
    assert.ok(await pressed(page, 'after'));
});

test('one scale for both', async () => {
    const range = async () => [
        await page.getByLabel('lower end').inputValue(),
        await page.getByLabel('upper end').inputValue(),
    ];
    const scale = await range();
    await press(page, '1');
    assert.deepEqual(await range(), scale);
    await press(page, '2');
});

test('points belong to the log that is shown', async () => {
    await press(page, '1');
    await goTo(page, 'point', 12000);
    const before_ = await numbers(page);
    await press(page, '2');
    await goTo(page, 'point', 12000);
    const after_ = await numbers(page);
    const [match] = JSON.parse(
        execFileSync(clsurf, ['query', part.program, older, '--point', before_.Point, '--json', '-q'], {
            encoding: 'utf8',
        }),
    ).matches;
    assert.equal(Number(before_.Line), match.line);
    assert.notEqual(before_.Line, after_.Line); // the missing loop lies before
});

test('the difference of both: what the earlier log lacks has no value', async () => {
    await page.click('[data-action="difference"]');
    await settled(page);
    assert.deepEqual(await layers(), ['visible', 'hidden']);
    const ends = [await page.getByLabel('lower end').inputValue(), await page.getByLabel('upper end').inputValue()];
    assert.equal(Number(ends[0]), -Number(ends[1])); // symmetric about 0
    assert.equal(await page.getByLabel('colour map').inputValue(), 'coolwarm');
    await comparePicture(page, 'difference');
    await press(page, '2');
    assert.notEqual(Number(await page.getByLabel('lower end').inputValue()), Number(ends[0]));
});

test('defects are gone, new or remaining', async () => {
    const found = (log) =>
        JSON.parse(execFileSync(clsurf, ['check', part.program, log, '--tool', 'none', '--json', '-q'])).defects.length;
    const { defects, gone } = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent));
    const [before_, after_] = [found(older), found(part.log)];
    assert.equal(defects.length, after_);
    const remaining = defects.filter((d) => d.change === 'remaining');
    assert.ok(remaining.length > 0 && remaining.every((d) => d.id_before >= 1 && d.id_before <= before_));
    assert.ok(gone.length + new Set(remaining.map((d) => d.id_before)).size <= before_);
    const text = await page.textContent('#change p');
    const fresh = after_ - remaining.length;
    const numbers_ = text.match(/\d+/g).map(Number);
    assert.deepEqual(numbers_, [before_, gone.length, after_, fresh, remaining.length]);
    if (gone.length > 0) {
        await page.click('.tree summary:has-text("Gone")');
        await page.click('[data-choice="gone-0"]');
        assert.ok(await pressed(page, 'before'));
        await press(page, '2');
    }
});

test('on paper the findings wrap: a wider table would shrink the whole sheet', async () => {
    await page.emulateMedia({ media: 'print' });
    await page.setViewportSize({ width: 718, height: 1046 }); // A4 less margins of 1 cm, in CSS pixels
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 718);
    await page.emulateMedia({ media: 'screen' });
    await page.setViewportSize({ width: 1280, height: 800 });
});

test('the line between is dragged', async () => {
    await press(page, 'w');
    const box = await page.locator('.layer').first().boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 4, box.y + 200, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const clip = await page
        .locator('.layer')
        .nth(1)
        .evaluate((layer) => layer.style.clipPath);
    assert.match(clip, /^inset\(0(px)? 7[45]\.?\d*% 0(px)? 0(px)?\)$/);
    await page.mouse.move(2, 2);
    await page.click('[data-action="command"]');
    assert.match(await page.getByLabel('command line').inputValue(), / --before /);
    await page.keyboard.press('Escape');
});

test('the wipe as a picture', async () => {
    await press(page, 't');
    await comparePicture(page, 'wipe');
});
