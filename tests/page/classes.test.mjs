// Fields whose values are names: each class has one colour and its name in view, range, curves and numbers, and no colour
// lies between two of them.

import assert from 'node:assert/strict';
import path from 'node:path';
import { test } from 'node:test';

import {
    bottle,
    closeReport,
    countPixels,
    data,
    folder,
    goTo,
    numbers,
    openReport,
    run,
    settled,
    useReport,
    writeReport,
} from './browser.mjs';

let page;
useReport(
    () => {
        const simulated = (name, machine) => {
            const log = path.join(folder, name);
            run('simulate', bottle.program, '-o', log, '-q', '--machine', `${data}/machines/${machine}.toml`);
            return log;
        };
        const log = simulated('run.biip', 'linuxcnc_kernel');
        const older = simulated('older.biip', 'three_axis_mill');
        return writeReport('classes.html', { ...bottle, log }, '--before', older, '--tool', 'none');
    },
    (opened) => (page = opened),
);

const named = ['feed', 'axis acceleration', 'block time'];
const list = () => page.$$eval('.range .classes li span', (all) => all.map((name) => name.textContent));

/** The colours of classes, as the page lists them. */
const colours = () =>
    page.$$eval('.range .classes i', (all) => all.map((i) => i.style.background.match(/\d+/g).map(Number)));

/** The surface has the colours of the classes only, however the light falls. */
async function expectNothingBetween() {
    const classes = await colours();
    const isClass = (rgb) =>
        classes.some((c) => {
            const light = rgb.reduce((sum, v, k) => sum + v * c[k], 0) / c.reduce((sum, v) => sum + v * v, 0);
            return light > 0.75 && light < 1.02 && rgb.every((v, k) => Math.abs(v - light * c[k]) < 5);
        });
    await page.evaluate(() => (document.querySelector('.overlay').style.visibility = 'hidden'));
    let all = 0;
    const strange = await countPixels(page, page.locator('.layer').first(), (...rgb) => {
        if (Math.min(...rgb) > 245) return false;
        ++all;
        return !isClass(rgb);
    });
    await page.evaluate(() => (document.querySelector('.overlay').style.visibility = ''));
    assert.ok(all > 20_000, `${all} pixels of the surface`);
    assert.ok(strange < 0.06 * all, `${strange} of ${all} pixels are in no colour of a class`); // edges are smoothed
}

test('the view has the colours of the classes and none between', async () => {
    await page.getByLabel('field').selectOption({ label: 'What limits the speed' });
    await page.click('[data-action="top"]');
    await settled(page);
    await expectNothingBetween();
    assert.ok(await page.getByLabel('colour map').isDisabled());
});

test('range, curve and numbers name the classes', async () => {
    const names = await list();
    for (const name of named) assert.ok(names.includes(name), `${name}: ${names}`);
    assert.ok(!(await page.locator('.range canvas').isVisible()));
    const key = await page.locator('.chart .key').first().innerText();
    for (const name of named) assert.ok(key.includes(name), `${name}: ${key}`);
    await goTo(page, 'time', 10);
    assert.ok(names.includes((await numbers(page))['What limits the speed']));
});

test('colours are those of render', async () => {
    const { surfaces } = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent));
    const field = surfaces[0].fields.find(({ name }) => name === 'limit');
    const rgb = Object.fromEntries(field.classes.map((c) => [c.name, c.rgb]));
    // The muted scheme of Paul Tol, in the order of the limits; grey is the feed.
    assert.deepEqual(rgb['at rest'], [204, 102, 119]);
    assert.deepEqual(rgb.feed, [226, 226, 226]);
    assert.deepEqual(rgb['axis acceleration'], [221, 204, 119]);
    assert.deepEqual(rgb['block time'], [170, 68, 153]);
});

test('of two curves it is said which log each is, of classes which stands above', async () => {
    const key = (k) => page.locator('.chart .key').nth(k).innerText();
    assert.match(await key(0), /after above, before below/);
    assert.match(await key(1), /after\s+before/);
    await page.click('[data-action="before"]');
    await settled(page);
    assert.equal(await page.locator('.chart .key').nth(1).isVisible(), false);
    await page.click('[data-action="after"]');
});

test('the difference of two runs shows where they have another class', async () => {
    await page.click('[data-action="difference"]');
    await settled(page);
    assert.deepEqual(await list(), ['as before', 'different']);
    await expectNothingBetween();
    await page.getByLabel('field').selectOption({ label: 'Path speed [mm/min]' });
    await settled(page);
    assert.ok(await page.locator('.range canvas').isVisible());
    assert.equal(await page.getByLabel('colour map').inputValue(), 'coolwarm');
});

test('the command line of two runs leaves out the other log where each log has classes of its own', async () => {
    const log = path.join(folder, 'run.biip');
    const older = path.join(folder, 'older.biip');
    const options = ['--before', older, '--tool', 'none', '--fields', 'limit,interval'];
    const both = await openReport(
        page.context().browser(),
        writeReport('commands.html', { ...bottle, log }, ...options),
    );
    await both.click('[data-action="difference"]');
    const commandOf = async (label) => {
        await both.getByLabel('field').selectOption({ label });
        await settled(both);
        await both.click('[data-action="command"]');
        const words = await both.getByLabel('command line').inputValue();
        await both.keyboard.press('Escape');
        return words;
    };
    assert.match(await commandOf('What limits the speed'), / --before /);
    // No legend of two maps can list the intervals of both.
    const interval = 'Planned speed of the constant-speed interval [mm/min]';
    assert.doesNotMatch(await commandOf(interval), / --before /);
    await closeReport(both);
});
