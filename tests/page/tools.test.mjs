// Every button and every key does what its tooltip says.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { beforeEach, test } from 'node:test';

import { clickView, numbers, press, pressed, reports, settled, useReport } from './browser.mjs';

let page;
useReport(
    () => reports.ball,
    (opened) => (page = opened),
);
beforeEach(() => press(page, 'i'));

const view = () => page.getAttribute('.view', 'data-view');
const field = () => page.getByLabel('field').evaluate((select) => select.selectedOptions[0].text);
const range = async () =>
    [await page.getByLabel('lower end').inputValue(), await page.getByLabel('upper end').inputValue()].map(Number);
/** At rest: where a machine draws slowly, points stand for the mesh until nothing has moved for a quarter of a second. */
const picture = async () => {
    const drawn = () => page.getAttribute('.view', 'data-drawn');
    for (let before = null, now = await drawn(); now !== before;) {
        before = now;
        await page.waitForTimeout(400);
        now = await drawn();
    }
    return (await page.locator('.overlay').screenshot()).toString('base64');
};

test('views', async () => {
    for (const [name, key] of [
        ['top', 't'],
        ['front', 'f'],
        ['left', 'l'],
        ['iso', 'i'],
    ]) {
        await page.click('[data-action="fit"]');
        await press(page, key);
        assert.equal(await view(), `view ${name}`);
        await press(page, 'i');
        await page.click(`[data-action="${name}"]`);
        await settled(page);
        assert.equal(await view(), `view ${name}`);
    }
});

test('dragging turns, the wheel zooms, fit shows the whole part again', async () => {
    const whole = await picture();
    await page.mouse.move(500, 300);
    await page.mouse.down();
    await page.mouse.move(560, 320, { steps: 3 });
    await page.mouse.up();
    await settled(page);
    assert.match(await view(), /^21°, 43°$/);
    await page.mouse.wheel(0, -400);
    await press(page, 'i');
    assert.equal(await picture(), whole);
    await page.mouse.wheel(0, -400);
    await settled(page);
    assert.notEqual(await picture(), whole);
    await press(page, 'h');
    assert.equal(await picture(), whole);
});

test('surface, lines, points', async () => {
    for (const [name, key] of [
        ['lines', 'n'],
        ['points', 'o'],
        ['surface', 's'],
    ]) {
        await press(page, key);
        assert.ok(await pressed(page, name));
        await clickView(page, 330, 250);
        await page.click(`[data-action="${name === 'surface' ? 'lines' : 'surface'}"]`);
        await page.click(`[data-action="${name}"]`);
        assert.ok(await pressed(page, name));
    }
    await press(page, 's');
});

test('box zoom shows what the box held', async () => {
    await press(page, 't');
    await clickView(page, 330, 210);
    const middle = await numbers(page);
    await press(page, 'b');
    assert.ok(await pressed(page, 'box'));
    const box = await page.locator('.overlay').boundingBox();
    await page.mouse.move(box.x + 280, box.y + 180);
    await page.mouse.down();
    await page.mouse.move(box.x + 380, box.y + 240, { steps: 3 });
    await page.mouse.up();
    await settled(page);
    assert.ok(!(await pressed(page, 'box')));
    const size = await page.evaluate(() => [
        document.querySelector('.layer').clientWidth,
        document.querySelector('.layer').clientHeight,
    ]);
    await clickView(page, Math.round(size[0] / 2), Math.round(size[1] / 2));
    const now = await numbers(page);
    assert.ok(Math.abs(Number(now.Point) - Number(middle.Point)) < 12, `${now.Point} is not ${middle.Point}`);
});

test('measure gives the distance of two places', async () => {
    await press(page, 'm');
    const before = await picture();
    await clickView(page, 300, 250);
    await clickView(page, 400, 250);
    assert.notEqual(await picture(), before);
    await press(page, 'm');
    assert.ok(!(await pressed(page, 'measure')));
});

test('outlines, defects forth and back', async () => {
    await press(page, 'u');
    assert.ok(await pressed(page, 'defects'));
    await page.click('[data-action="defects"]');
    assert.ok(!(await pressed(page, 'defects')));
    const chosen = () => page.getAttribute('.tree .item[aria-pressed="true"]', 'data-choice');
    await press(page, 'd');
    const first = await chosen();
    await page.click('[data-action="next-defect"]');
    assert.notEqual(await chosen(), first);
    await press(page, 'v');
    assert.equal(await chosen(), first);
    await page.click('[data-action="next-defect"]');
    await page.click('[data-action="previous-defect"]');
    assert.equal(await chosen(), first);
});

test('the cursor goes from point to point', async () => {
    await page.click('[data-action="card-close"]'); // the card of the defect lies over the view
    await clickView(page, 330, 250);
    const { Point } = await numbers(page);
    await press(page, '.');
    assert.equal(Number((await numbers(page)).Point), Number(Point) + 1);
    await press(page, ',');
    assert.equal((await numbers(page)).Point, Point);
});

test('curves over time or over way', async () => {
    const label = () => page.locator('.chart').last().screenshot();
    const overTime = (await label()).toString('base64');
    await press(page, 'x');
    assert.notEqual((await label()).toString('base64'), overTime);
    await page.click('[data-action="over"]');
    await settled(page);
    assert.equal((await label()).toString('base64'), overTime);
});

test('fields bring their range and a colour map that fits', async () => {
    await page.getByLabel('field').selectOption({ label: 'Acceleration along the path [mm/s²]' });
    await settled(page);
    assert.equal(await page.getByLabel('colour map').inputValue(), 'coolwarm');
    const [low, high] = await range();
    assert.ok(low === -high && high > 0);
    await page.getByLabel('field').selectOption({ label: 'Path speed [mm/min]' });
    await settled(page);
    assert.equal(await page.getByLabel('colour map').inputValue(), 'magma');
    assert.equal(await field(), 'Path speed [mm/min]');
    await page.getByLabel('curve 2', { exact: true }).selectOption({ label: 'Jerk [mm/s³]' });
    await settled(page);
    assert.equal(await page.locator('.chart').count(), 2);
});

test('colour maps and steps', async () => {
    const seen = new Set();
    for (let k = 0; k < 6; ++k) {
        await press(page, 'k');
        seen.add(await picture());
    }
    assert.equal(seen.size, 6);
    await page.getByLabel('colour steps').selectOption('8');
    await settled(page);
    assert.ok(!seen.has(await picture()));
    await page.getByLabel('colour steps').selectOption('0');
    await page.getByLabel('colour map').selectOption('magma');
});

test('the range is typed, dragged, and usual again', async () => {
    const usual = await range();
    await page.getByLabel('upper end').fill('2500');
    await page.getByLabel('upper end').press('Enter');
    await settled(page);
    assert.deepEqual(await range(), [usual[0], 2500]);
    const box = await page.locator('.range canvas').boundingBox();
    await page.mouse.move(box.x + 25, box.y + 5);
    await page.mouse.down();
    await page.mouse.move(box.x + 70, box.y + 5, { steps: 3 });
    await page.mouse.up();
    const dragged = await range();
    assert.ok(dragged[0] > usual[0] + 200 && dragged[1] === 2500, String(dragged));
    await page.click('[data-action="range-all"]');
    const all = await range();
    assert.ok(all[0] < usual[0] && all[1] === 3000, String(all)); // the usual one has a round upper end above it
    await page.click('[data-action="range-auto"]');
    assert.deepEqual(await range(), usual);
    await page.getByLabel('lower end').fill('9999'); // above the upper end: not taken
    await page.getByLabel('lower end').press('Enter');
    assert.deepEqual(await range(), usual);
});

test('positions and the as-machined surface', async () => {
    for (const name of ['feedback', 'formed', 'commanded']) {
        await page.locator('.choices button', { hasText: name }).click();
        await settled(page);
        assert.equal(
            await page.locator('.choices button[aria-pressed="true"]:not([data-choice^="kind-"])').textContent(),
            name,
        );
        assert.equal(await page.getByLabel('colour map').inputValue(), name === 'formed' ? 'coolwarm' : 'magma');
        assert.equal(/^As-machined surface/.test(await field()), name === 'formed'); // the list of fields says it, too
    }
});

test('the view is saved as PNG', async () => {
    const waiting = page.waitForEvent('download');
    await press(page, 'p');
    const download = await waiting;
    assert.equal(download.suggestedFilename(), 'bottle_uneven.nc.png');
    assert.equal(
        fs
            .readFileSync(await download.path())
            .subarray(1, 4)
            .toString(),
        'PNG',
    );
    const again = page.waitForEvent('download');
    await page.click('[data-action="save"]');
    await again;
});

test('light and dark', async () => {
    const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
    assert.equal(await theme(), 'light');
    await press(page, 'y');
    assert.equal(await theme(), 'dark');
    await page.click('[data-action="theme"]');
    assert.equal(await theme(), 'light');
});

test('the command line and the list of keys open and close', async () => {
    // A browser tells of a closed dialog a task later than it closes it.
    const gone = () => page.locator('dialog').waitFor({ state: 'detached' });
    await press(page, 'r');
    assert.match(await page.getByLabel('command line').inputValue(), /^clsurf render /);
    await page.click('[data-action="copy"]');
    await page.click('[data-action="close"]');
    await gone();
    await page.click('[data-action="command"]');
    await page.keyboard.press('Escape');
    await gone();
    await press(page, '?');
    // Each key stands there once.
    const keys = await page.$$eval('kbd', (all) => all.map((key) => key.textContent));
    assert.equal(new Set(keys).size, keys.length);
    await page.click('[data-action="close"]');
    await gone();
    await page.click('[data-action="help"]');
    await page.keyboard.press('Escape');
    await gone();
});

test('G goes to the field for numbers, where keys are letters', async () => {
    await press(page, 'g');
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'go to');
    await page.keyboard.type('t');
    await settled(page);
    assert.equal(await view(), 'view iso');
    await page.getByLabel('go to', { exact: true }).fill('');
});

test('every button has a tooltip with its key', async () => {
    const titles = await page.$$eval('.toolbar button', (all) => all.map((b) => b.title));
    for (const title of titles) assert.match(title, /\(key .\)$/);
});

test('kinds of motion and passes that are drawn', async () => {
    const whole = await picture();
    await page.click('.passes summary');
    const box = (name) => page.getByLabel(`${name} pass drawn`);
    await box('first').fill('10');
    await box('last').fill('20');
    await box('last').press('Enter');
    await settled(page);
    const part = await picture();
    assert.notEqual(part, whole);
    await page.click('[data-action="next-defect"]'); // on pass 14
    await page.click('[data-action="iso"]');
    await page.click('[data-action="lines"]');
    const lines = await picture();
    await page.click('[data-choice="kind-0"]');
    assert.equal(await page.getAttribute('[data-choice="kind-0"]', 'aria-pressed'), 'false');
    assert.notEqual(await picture(), lines);
    await page.click('[data-choice="kind-0"]');
    assert.equal(await picture(), lines);
    await page.click('[data-action="surface"]');
    await box('first').fill('1');
    await box('last').fill('41');
    await box('last').press('Enter');
    await page.click('[data-action="card-close"]');
    await page.click('.passes summary');
});
