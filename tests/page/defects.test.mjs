// The table of all defects: sorted, filtered and saved, by mouse and by keys; its numbers are those of `check`.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { test } from 'node:test';

import { checkedBottle, chosenLine, numbers, press, reports, settled, useReport } from './browser.mjs';

let page;
useReport(
    () => reports.bottle,
    (opened) => (page = opened),
);

const { defects } = checkedBottle();
const ranks = () => page.$$eval('#defect-list tbody tr', (rows) => rows.map((row) => Number(row.dataset.defect)));
const head = (name) => page.locator('#defect-list th', { hasText: name });
const choose = (name, value) => page.getByLabel(name, { exact: true }).selectOption(value);
/** Ranks of the defects that pass, the worst first. */
const expected = (passes) => defects.flatMap((defect, k) => (passes(defect) ? [k + 1] : []));

test('a click on a head sorts, a second one the other way round', async () => {
    assert.deepEqual(
        await ranks(),
        expected(() => true),
    );
    await head('Depth').locator('button').click();
    assert.equal(await head('Depth').getAttribute('aria-sort'), 'ascending');
    const depths = (await ranks()).map((rank) => defects[rank - 1].depth_um);
    for (let k = 1; k < depths.length; ++k) assert.ok(depths[k] >= depths[k - 1] - 0.011, `${depths}`);
    await head('Depth').locator('button').press('Enter');
    assert.equal(await head('Depth').getAttribute('aria-sort'), 'descending');
    const deepest = defects[(await ranks())[0] - 1].depth_um;
    assert.ok(Math.max(...defects.map((d) => d.depth_um)) - deepest < 0.011);
    await head('Rank').locator('button').click();
});

test('filters by severity, cause and pass leave what check finds', async () => {
    const severity = Math.max(...defects.map((d) => d.severity));
    await choose('severity of defects', String(severity));
    assert.deepEqual(
        await ranks(),
        expected((d) => d.severity === severity),
    );
    await choose('severity of defects', '');
    const { cause } = defects.at(-1);
    await choose('cause of defects', cause);
    assert.deepEqual(
        await ranks(),
        expected((d) => d.cause === cause),
    );
    assert.equal(await page.textContent('#defect-list .count'), `${(await ranks()).length} of ${defects.length}`);
    await choose('cause of defects', '');
    const pass = await page.getByLabel('pass of defects').evaluate((select) => select.options[1].value);
    await choose('pass of defects', pass);
    assert.ok((await ranks()).length > 0 && (await ranks()).length < defects.length);
    await choose('pass of defects', '');
    assert.equal((await ranks()).length, defects.length);
});

test('one filter for the table, the list, the view and the key D', async () => {
    const { pass } = await page.evaluate(() => {
        const manifest = JSON.parse(document.getElementById('manifest').textContent);
        return { pass: manifest.defects[1].runs[0].pass };
    });
    await page.click('.tree .filter summary');
    await choose('pass of the list', String(pass));
    const left = await ranks();
    assert.ok(left.includes(2) && left.length < defects.length);
    assert.equal(await page.getByLabel('pass of defects').inputValue(), String(pass));
    const listed = await page.$$eval('.tree .list .item[data-choice^="defect-"]', (all) =>
        all.filter((item) => item.checkVisibility()).map((item) => Number(item.textContent.match(/^\d+/)[0])),
    );
    assert.deepEqual(listed, left);
    assert.match(await page.textContent('.tree > details > summary'), /^Defects \(\d+ of \d+\)$/);
    for (const rank of [...left, left[0]]) {
        await press(page, 'd');
        assert.equal(await page.evaluate(() => window.location.hash), `#defect-${rank}`);
    }
    await choose('pass of the list', '');
    await choose('quantity of the list', 'lag');
    assert.deepEqual(
        await ranks(),
        expected((d) => d.quantity === 'lag'),
    );
    await choose('quantity of the list', '');
    await page.click('[data-action="card-close"]');
});

test('the depth on a card is that of its sentence', async () => {
    const manifest = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent));
    let compared = 0;
    for (const { depth_um: depth, text } of manifest.defects) {
        const [, said] = /predicted \w+ of ([\d.]+) µm/.exec(text) ?? [];
        if (said === undefined) continue;
        ++compared;
        assert.equal(depth.toFixed(1), said, text);
    }
    assert.ok(compared > 0);
    // With all its digits: rounded to two decimals and then to one, 5.949 became 6.0.
    assert.ok(manifest.defects.some(({ depth_um: depth }) => depth !== Number(depth.toFixed(2))));
});

test('the card of a defect stays until it is closed', async () => {
    await press(page, 'd');
    const card = page.locator('.card');
    const rank = Number((await card.locator('h2').textContent()).match(/\d+$/)[0]);
    const defect = defects[rank - 1];
    assert.ok(
        (await card.textContent()).includes(
            `${defect.depth_um.toFixed(1)} µm${defect.shape === 'none' ? '' : ` ${defect.shape}`}`,
        ),
    );
    await page.click('.program .row >> nth=3');
    assert.ok(await card.isVisible());
    // Nothing in its head is cut off or wrapped.
    const [wide, rows] = await card.evaluate((element) => [
        element.scrollWidth - element.clientWidth,
        new Set([...element.querySelectorAll('.head button')].map((button) => button.offsetTop)).size,
    ]);
    assert.deepEqual([wide, rows], [0, 1]);
    // The defect, in the middle of the map, is not below it.
    const [layer, over] = [await page.locator('.layer').first().boundingBox(), await card.boundingBox()];
    assert.ok(over.x > layer.x + layer.width / 2, `${over.x}`);
    // Nor is the legend, right of the map.
    const view = await page.locator('.view').boundingBox();
    const legend = layer.x + layer.width;
    assert.ok(over.x >= view.x + view.width || over.x + over.width <= legend, `${over.x} is over ${legend}`);
    await card.locator('[data-action="card-line"]').first().click();
    await settled(page);
    assert.equal(await chosenLine(page), defect.lines[0][0]);
    await card.locator('[data-action="card-show"]').click();
    assert.equal(Number((await numbers(page)).Point), defect.point);
    await card.locator('[data-action="card-next"]').click();
    assert.equal(await card.locator('h2').textContent(), `Defect ${(rank % defects.length) + 1}`);
    await card.locator('[data-action="card-close"]').click();
    assert.equal(await card.isVisible(), false);
});

test('CSV has the defects of the table in its order', async () => {
    await choose('cause of defects', defects[0].cause);
    await head('Length').locator('button').click();
    const order = await ranks();
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-action="save-defects"]')]);
    assert.equal(download.suggestedFilename(), 'bottle_uneven.nc.defects.csv');
    const text = fs.readFileSync(await download.path(), 'utf8');
    assert.ok(text.endsWith('\r\n'));
    const [names, ...rows] = text
        .trimEnd()
        .split('\r\n')
        .map((row) => row.match(/"(?:[^"]|"")*"|[^,]+|(?<=,)(?=,|$)/g));
    assert.deepEqual(
        rows.map((row) => Number(row[0])),
        order,
    );
    for (const row of rows) {
        assert.equal(row.length, names.length);
        const defect = defects[Number(row[0]) - 1];
        assert.equal(row[names.indexOf('cause')], defect.cause);
        assert.equal(Number(row[names.indexOf('severity')]), defect.severity);
        assert.ok(Math.abs(Number(row[names.indexOf('depth_um')]) - defect.depth_um) < 0.011);
    }
    await choose('cause of defects', '');
    await head('Rank').locator('button').click();
});

test('a row, and its link by key, lead to the defect', async () => {
    await page.locator('#defect-list tr[data-defect="3"] a').focus();
    await page.keyboard.press('Enter');
    assert.equal(Number((await numbers(page)).Point), defects[2].point);
    await page.click('#defect-list tr[data-defect="2"] td:nth-child(3)');
    await settled(page);
    assert.equal(await page.evaluate(() => window.location.hash), '#defect-2');
});

test('on a phone the table stays in the page', async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await page.locator('#defect-list').scrollIntoViewIfNeeded();
    for (const name of ['.filters', '.wide']) {
        const { x, width } = await page.locator(`#defect-list ${name}`).boundingBox();
        assert.ok(x >= 0 && x + width <= 390, `${name} ends at ${x + width}`);
    }
    await head('Depth').locator('button').click();
    assert.equal(await head('Depth').getAttribute('aria-sort'), 'ascending');
});
