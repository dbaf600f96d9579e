// A defect that the reader accepts and comments goes into a file, and `check` reads it.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';

import {
    bottle,
    closeReport,
    folder,
    openReport,
    press,
    reports,
    run,
    settled,
    startBrowser,
    writeReport,
} from './browser.mjs';

let browser, page;
before(async () => {
    browser = await startBrowser();
    page = await openReport(browser, reports.bottle);
});
after(async () => {
    try {
        await closeReport(page);
    } finally {
        await browser?.close();
    }
});

const accepted = path.join(folder, 'bottle.accepted.json');
const list = () => page.$$eval('.tree .list .item.accepted', (all) => all.map((e) => parseInt(e.textContent, 10)));
const open = async (of, file) => {
    const [chooser] = await Promise.all([of.waitForEvent('filechooser'), of.click('[data-action="load-accepted"]')]);
    await chooser.setFiles(file);
    await settled(of);
};

test('a comment with markup is text, and the list shows what is accepted', async () => {
    for (const [rank, comment] of [
        [1, 'polished <b>by hand</b>'],
        [2, ''],
    ]) {
        await page.click(`[data-choice="defect-${rank - 1}"]`);
        await page.getByLabel('Accepted', { exact: true }).check();
        await page.getByLabel('comment', { exact: true }).fill(comment);
        await page.getByLabel('comment', { exact: true }).blur();
    }
    await page.click('[data-choice="defect-2"]');
    await page.getByLabel('comment', { exact: true }).fill('look at it');
    await page.getByLabel('comment', { exact: true }).blur();
    assert.deepEqual(await list(), [1, 2]);
    const row = await page.textContent('#defect-list tr[data-defect="1"]');
    assert.ok(row.includes('accepted: polished <b>by hand</b>'), row);
    await page.getByLabel('state of defects').selectOption('open');
    assert.equal(await page.locator('#defect-list tr[data-defect="1"]').count(), 0);
    await page.getByLabel('state of defects').selectOption('');
});

test('the file is what check reads', async () => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-action="save-accepted"]')]);
    assert.equal(download.suggestedFilename(), 'bottle_uneven.nc.accepted.json');
    await download.saveAs(accepted);
    const report = JSON.parse(
        run('check', bottle.program, bottle.log, '--tool', 'none', '--accepted', accepted, '--json'),
    );
    assert.deepEqual(
        report.defects.filter((d) => d.accepted).map((d) => d.id),
        [1, 2],
    );
    assert.deepEqual(
        report.accepted.map(({ id, state, comment }) => [id, state, comment]),
        [
            [1, 'accepted', 'polished <b>by hand</b>'],
            [2, 'accepted', ''],
            [3, 'commented', 'look at it'],
        ],
    );
});

test('it is read back, by another page and by report', async () => {
    const other = await openReport(browser, reports.bottle);
    await open(other, accepted);
    assert.equal(await other.locator('.tree .item.accepted').count(), 2);
    assert.match(await other.textContent('.note-of-file'), /^3 of 3 are on this page$/);
    await closeReport(other);
    const begun = await openReport(
        browser,
        writeReport('begun.html', bottle, '--tool', 'none', '--accepted', accepted),
    );
    assert.equal(await begun.locator('.tree .item.accepted').count(), 2);
    await press(begun, 'd');
    assert.ok(await begun.getByLabel('Accepted', { exact: true }).isChecked());
    await closeReport(begun);
});

test('what does not fit is said', async () => {
    const file = JSON.parse(fs.readFileSync(accepted, 'utf8'));
    file.defects[0].severity = 1; // it was a trace: it is distinct now
    file.defects[1].fingerprint = 'feed_drop/speed/99/0/0/0';
    const changed = path.join(folder, 'changed.json');
    fs.writeFileSync(changed, JSON.stringify(file));
    await open(page, changed);
    assert.deepEqual(await list(), []);
    assert.match(await page.textContent('.note-of-file'), /1 not found.*1 not accepted: worse than it was/);
    const broken = path.join(folder, 'broken.json');
    fs.writeFileSync(broken, '{"clsurf_accepted": 2}');
    await open(page, broken);
    assert.match(await page.textContent('.note-of-file'), /broken.json: this is not a file of accepted defects/);
});

test('the card prints with its lines', async () => {
    await page.evaluate(() => (window.print = () => (window.printed = document.body.className)));
    await page.click('[data-choice="defect-0"]');
    await page.click('[data-action="card-print"]');
    await page.waitForFunction(() => window.printed);
    assert.equal(await page.evaluate(() => window.printed), 'print-one');
    await page.emulateMedia({ media: 'print' });
    const card = page.locator('.print-card');
    assert.ok(await card.isVisible());
    assert.equal(await page.locator('#report').isVisible(), false);
    const text = await card.textContent();
    assert.ok(text.includes('Adjacent lines'), text);
    const program = fs.readFileSync(bottle.program, 'utf8').split('\n');
    const [first, last] = await page.evaluate(
        () => JSON.parse(document.getElementById('manifest').textContent).defects[0].runs[0].lines,
    );
    for (const line of [first, first + 9, last])
        assert.ok(text.includes(`${line} ${program[line - 1].trimEnd()}`), `line ${line}`);
    await page.evaluate(() => window.dispatchEvent(new window.Event('afterprint')));
    assert.equal(await card.count(), 0);
    // The whole page prints the strongest ones with their lines, too.
    const cards = await page.$$eval('.defect-card pre', (all) => all.map((pre) => pre.textContent));
    assert.equal(cards.length, 6);
    assert.ok(cards[0].includes(`${first} ${program[first - 1].trimEnd()}`), cards[0]);
    assert.ok(cards[0].includes(`${last} ${program[last - 1].trimEnd()}`));
    await page.emulateMedia({ media: 'screen' });
});
