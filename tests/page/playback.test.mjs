// Playback: the tool goes along its way, and line, curves and numbers follow.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bottle, goTo, numbers, press, reports, run, settled, useReport } from './browser.mjs';

let page;
useReport(
    () => reports.ball,
    (opened) => (page = opened),
);

const clock = async () => parseFloat(await page.textContent('.player output'));
const slide = async (time) => {
    await page.getByLabel('time', { exact: true }).fill(String(time));
    await settled(page);
};

test('the slider moves the tool: the point is that of the time', async () => {
    await slide(12.5);
    const shown = await numbers(page);
    const [match] = JSON.parse(
        run('query', bottle.program, bottle.log, '--time', '12.5', '--json', '-q', '--tool', 'none'),
    ).matches;
    assert.equal(Number(shown.Point), match.point);
    assert.equal(Number(shown.Line), match.line);
});

test('the shape is drawn, and another view sees it from there', async () => {
    await press(page, 'f');
    await slide(13);
    const accent = await page.evaluate(() => {
        const canvas = document.querySelector('.overlay');
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
        let [left, right] = [Infinity, -Infinity];
        for (let i = 0; i < data.length; i += 4) {
            if (data[i] !== 194 || data[i + 1] !== 24 || data[i + 2] !== 91) continue; // --accent
            const x = (i / 4) % canvas.width;
            left = Math.min(left, x);
            right = Math.max(right, x);
        }
        return right - left;
    });
    const bar = await page.evaluate(() => document.querySelector('.overlay').clientWidth);
    assert.ok(accent > 20 && accent < bar, `${accent} of ${bar}`);
});

test('it plays at the chosen speed, and pauses', async () => {
    await slide(5);
    await page.getByLabel('speed of playback').selectOption('1');
    const begin = Date.now();
    await page.click('.player [data-action="play"]');
    // However slowly a machine draws: no faster than the run.
    await page.waitForFunction(() => parseFloat(document.querySelector('.player output').textContent) > 5.2);
    await press(page, 'a');
    const passed = (Date.now() - begin) / 1000;
    const time = await clock();
    assert.ok(time > 5.2 && time < 5 + passed + 0.2, `${time} s after ${passed} s`);
    await page.waitForTimeout(300);
    assert.equal(await clock(), time);
    assert.ok(Math.abs(Number((await numbers(page)).Time) - time) < 0.3);
});

test('it ends at the end, and begins again', async () => {
    await slide(27.4);
    await page.getByLabel('speed of playback').selectOption('100');
    await page.click('.player [data-action="play"]');
    await page.waitForFunction(() => document.querySelector('.player button').title === 'play');
    assert.equal(await clock(), 27.516);
    await page.getByLabel('speed of playback').selectOption('0.1');
    await page.click('.player [data-action="play"]');
    await settled(page);
    assert.ok((await clock()) < 5);
    await press(page, 'a');
});

test('a place that is chosen is where the tool goes', async () => {
    await goTo(page, 'point', 9000);
    assert.equal(await clock(), 9);
});
