// A place, its line, its point on the curves, a defect: each leads to the others, and what the page says
// is what `clsurf query` and `check` say.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
    bottle,
    checkedBottle,
    chosenLine,
    clickView,
    goTo,
    numbers,
    reports,
    run,
    settled,
    useReport,
} from './browser.mjs';

let page;
useReport(
    () => reports.bottle,
    (opened) => (page = opened),
);

const query = (...words) => JSON.parse(run('query', bottle.program, bottle.log, '--json', '-q', ...words)).matches;

test('a place that is clicked shows its line, as query says', async () => {
    await page.click('[data-action="top"]');
    for (const [x, y] of [
        [200, 200],
        [330, 250],
        [410, 150],
    ]) {
        await clickView(page, x, y);
        const shown = await numbers(page);
        const [match] = query('--point', shown.Point);
        assert.equal(Number(shown.Line), match.line);
        assert.equal(await chosenLine(page), match.line);
        assert.ok((await page.textContent('.program .row.chosen code')).includes(match.text.trim()));
        const place = shown['X Y Z'].split(/\s+/).map(Number);
        match.tip_mm.forEach((c, k) => assert.ok(Math.abs(c - place[k]) < 2e-4, `${place} is not ${match.tip_mm}`));
        assert.ok(Math.abs(Number(shown['Path speed']) - match.speed_mm_min) < 0.2);
        assert.ok(Math.abs(Number(shown.Time) - match.time_s) < 1e-4);
    }
});

test('why the tool is slow at any point, in the words of query', async () => {
    let slow = 0;
    for (const point of [560, 4848, 4822, 9100, 13_500, 20_000, 23_519]) {
        await goTo(page, 'point', point);
        const [match] = query('--point', String(point));
        const reasons = match.slow_because ?? [];
        const words = `${match.speed_mm_min.toFixed(0)} of F${match.feed_mm_min} mm/min: ${reasons.join('; ')}`;
        assert.equal((await numbers(page)).Slow, reasons.length > 0 ? words : 'no');
        slow += Number(reasons.length > 0);
    }
    assert.ok(slow > 1 && slow < 7, `${slow} points are slow`);
});

test('from above, a pixel to the right is X, a pixel down is Y, both alike', async () => {
    await page.click('[data-action="top"]');
    const places = [];
    for (const [x, y] of [
        [250, 120],
        [450, 120],
        [250, 320],
    ]) {
        await clickView(page, x, y);
        places.push((await numbers(page))['X Y Z'].split(/\s+/).map(Number));
    }
    const [dx, dy] = [places[1][0] - places[0][0], places[2][1] - places[0][1]];
    // Points lie 0.05 mm apart along a pass, passes 0.4 mm.
    assert.ok(dx > 2 && Math.abs(dx + dy) < 0.5, `${dx} mm to the right, ${dy} mm down`);
    assert.ok(Math.abs(places[1][1] - places[0][1]) < 0.25 && Math.abs(places[2][0] - places[0][0]) < 0.1);
});

test('a line that is clicked lights up its points, the first one ringed', async () => {
    await goTo(page, 'line', 560);
    await page.click('.program .row[data-line="568"]');
    const [match] = query('--line', '568');
    const shown = await numbers(page);
    assert.equal(Number(shown.Point), match.point);
    assert.equal(await chosenLine(page), 568);
});

test('arrow keys go through the program', async () => {
    await page.click('.program .row[data-line="568"]');
    await page.locator('.program').focus();
    await page.keyboard.press('ArrowDown');
    await settled(page);
    assert.equal(await chosenLine(page), 569);
    await page.keyboard.press('PageDown');
    await settled(page);
    assert.equal(await chosenLine(page), 589);
});

test('points, lines and times are found', async () => {
    await goTo(page, 'point', 4848);
    assert.equal((await numbers(page)).Point, '4848');
    assert.equal(await chosenLine(page), 568);
    await goTo(page, 'time', 4.848);
    assert.equal((await numbers(page)).Point, '4848');
    await goTo(page, 'line', 1564);
    assert.equal(Number((await numbers(page)).Point), query('--line', '1564')[0].point);
    await goTo(page, 'point', 99_999_999);
    assert.match(
        await page.getByLabel('go to', { exact: true }).evaluate((input) => input.validationMessage),
        /points 0 … 27516/,
    );
    await page.getByLabel('go to', { exact: true }).fill('');
});

test('a place on a curve that is clicked moves the cursor there', async () => {
    const over = page.locator('.chart .u-over').first();
    const box = await over.boundingBox();
    await over.click({ position: { x: Math.round(box.width / 2), y: 40 } });
    await page.mouse.move(2, 2);
    const shown = await numbers(page);
    assert.ok(Math.abs(Number(shown.Time) - 13.758) < 0.1, `half of 27.516 s is not ${shown.Time}`);
    assert.equal(await chosenLine(page), Number(shown.Line));
});

test('a curve is enlarged by dragging and whole again by a double click', async () => {
    const over = page.locator('.chart .u-over').first();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 100, box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + 200, box.y + 40, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    await over.click({ position: { x: 10, y: 40 } });
    await page.mouse.move(2, 2);
    const early = Number((await numbers(page)).Time);
    assert.ok(early > 2 && early < 6, `the window begins at ${early} s`);
    await over.dblclick({ position: { x: 10, y: 40 } });
    await settled(page);
    await over.click({ position: { x: 2, y: 40 } });
    await page.mouse.move(2, 2);
    assert.ok(Number((await numbers(page)).Time) < 0.2);
});

test('a defect moves the camera there and marks the lines of both passes', async () => {
    const { defects } = checkedBottle();
    await page.click('[data-choice="defect-0"]');
    await settled(page);
    const shown = await numbers(page);
    assert.equal(Number(shown.Point), defects[0].point);
    const marked = await page.$$eval('.program .row.fault', (rows) => rows.map((row) => Number(row.dataset.line)));
    assert.ok(marked.length > 0);
    for (const line of marked)
        assert.ok(
            defects[0].lines.some(([first, last]) => line >= first && line <= last),
            `line ${line} is none of defect 1's`,
        );
    const adjacent = defects.findIndex((d) => d.neighbours.lines.length > 0);
    await page.click(`[data-choice="defect-${adjacent}"]`);
    assert.ok((await page.textContent('.card')).includes('Adjacent lines'));
    await goTo(page, 'line', defects[adjacent].neighbours.lines[0][0]); // leaves the defect: lines are no longer marked
    assert.equal(await page.locator('.program .row.adjacent').count(), 0);
});

test('a defect brings the field that shows it, and a link to itself', async () => {
    const { defects } = checkedBottle();
    const fields = {
        speed: /^Speed difference|^Path speed/,
        lag: /^Height/,
        relief: /^Height/,
        acceleration: /^Acceleration/,
    };
    for (const quantity of ['speed', 'lag']) {
        const index = defects.findIndex((d) => d.quantity === quantity);
        await page.click(`[data-choice="defect-${index}"]`);
        await settled(page);
        const chosen = await page.getByLabel('field').evaluate((select) => select.selectedOptions[0].textContent);
        assert.match(chosen, fields[quantity]);
        assert.equal(await page.evaluate(() => window.location.hash), `#defect-${index + 1}`);
    }
    await page.evaluate(() => (window.location.hash = '#defect-3'));
    await settled(page);
    assert.equal(Number((await numbers(page)).Point), defects[2].point);
});

test('the table below leads to its defect too', async () => {
    await page.click('#report tr[data-defect="2"]');
    await settled(page);
    assert.equal(await page.getAttribute('[data-choice="defect-1"]', 'aria-pressed'), 'true');
});

test('a pass of the tree lights up', async () => {
    await page.click('.passes summary');
    await page.click('[data-choice="pass-18"]');
    assert.equal((await numbers(page)).Pass, '18');
});
