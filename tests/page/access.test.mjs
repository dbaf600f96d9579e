// For readers with a keyboard, a screen reader or a phone: axe-core finds nothing in light and dark, one-letter keys can
// be switched off (WCAG 2.1.4), and 390 pixels are wide enough.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { after, before, test } from 'node:test';

import { closeReport, numbers, openReport, press, reports, settled, startBrowser } from './browser.mjs';

const require = createRequire(path.join(process.env.PAGE_PACKAGES, 'package.json'));
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

let browser, file;
before(async () => {
    file = reports.ball;
    browser = await startBrowser();
});
after(() => browser?.close());

/** What axe-core objects to, as lines. */
async function violations(page) {
    await page.evaluate(axe);
    const { violations: found } = await page.evaluate(() => window.axe.run());
    return found.flatMap((rule) => rule.nodes.map((node) => `${rule.id}: ${node.target.join(' ')}`));
}

/** What leaves the page on its right side. */
const tooWide = (page) =>
    page.evaluate(() => {
        const width = document.documentElement.clientWidth;
        const inside = (e) => e.closest('.wide, .program, .toolbar > *'); // these scroll for themselves
        return [...document.body.querySelectorAll('*')]
            .filter((e) => !inside(e) && e.getBoundingClientRect().right > width + 1)
            .map((e) => `${e.tagName} ${e.className}`);
    });

for (const colorScheme of ['light', 'dark'])
    for (const width of [1440, 390])
        test(`axe-core finds nothing, ${colorScheme}, ${width} pixels wide`, async () => {
            const page = await openReport(browser, file, { width, height: 900, colorScheme });
            assert.deepEqual(await violations(page), []);
            await page.click('[data-action="next-defect"]');
            await page.click('.tree .filter summary');
            await settled(page);
            assert.deepEqual(await violations(page), []);
            await page.click('[data-action="help"]');
            assert.deepEqual(await violations(page), []);
            await page.keyboard.press('Escape');
            await closeReport(page);
        });

test('axe-core does find what is wrong', async () => {
    const page = await openReport(browser, file);
    await page.evaluate(() => document.querySelector('.overlay').before(document.createElement('button')));
    assert.deepEqual(
        (await violations(page)).map((text) => text.split(':')[0]),
        ['button-name'],
    );
    await closeReport(page);
});

test('one-letter keys are switched off, and stay so', async () => {
    const page = await openReport(browser, file);
    const view = () => page.getAttribute('.view', 'data-view');
    await press(page, 't');
    assert.equal(await view(), 'view top');
    await page.click('[data-action="help"]');
    await page.getByLabel('One-letter keys are on').uncheck();
    await page.keyboard.press('Escape');
    for (const key of ['f', 'd', '.', '?']) await press(page, key);
    assert.equal(await view(), 'view top');
    assert.equal(await page.locator('dialog').count(), 0);
    assert.equal(await page.locator('.card').isVisible(), false);
    assert.doesNotMatch(await page.getAttribute('[data-action="top"]', 'title'), /key/);
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready === 'yes');
    await press(page, 't');
    assert.equal(await view(), 'view iso');
    await page.click('[data-action="help"]');
    await page.getByLabel('One-letter keys are on').check();
    await page.keyboard.press('Escape');
    await press(page, 't');
    assert.equal(await view(), 'view top');
    await closeReport(page);
});

test('the view turns, moves and zooms by keys', async () => {
    const page = await openReport(browser, file);
    const view = () => page.getAttribute('.view', 'data-view');
    await page.locator('.view').focus();
    let before_ = await page.locator('.overlay').screenshot();
    for (const key of ['+', 'Shift+ArrowLeft', 'ArrowUp']) {
        await page.keyboard.press(key);
        await settled(page);
        const after_ = await page.locator('.overlay').screenshot();
        assert.notDeepEqual(after_, before_, key);
        before_ = after_;
    }
    assert.equal(await view(), '45°, 29°');
    await closeReport(page);
});

test('on a phone everything stands in one column', async () => {
    const page = await openReport(browser, file, { width: 390, height: 844 });
    assert.deepEqual(await tooWide(page), []);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    await page.click('[data-action="next-defect"]');
    await settled(page);
    assert.deepEqual(await tooWide(page), []);
    const tops = {};
    for (const name of ['.toolbar', '.view', '.card', '.side', '.curves', '.program', '.table']) {
        const { x, y, width, height } = await page.locator(name).boundingBox();
        assert.ok(x === 0 && width === 390 && height > 20, `${name}: ${x} ${width} ${height}`);
        tops[name] = y;
    }
    assert.deepEqual(
        Object.keys(tops),
        Object.keys(tops).sort((a, b) => tops[a] - tops[b]),
    );
    assert.ok((await numbers(page)).Point > 0);
    await closeReport(page);
});

test('on a phone the map is near the top, and the card of a defect comes into sight', async () => {
    const page = await openReport(browser, file, { width: 390, height: 844 });
    const at = async (name) => {
        const { y, height } = await page.locator(name).boundingBox();
        return { top: y, bottom: y + height };
    };
    assert.ok((await at('.view')).top < 844 / 3, `the map begins at ${(await at('.view')).top}`);
    const inSight = async (how) => {
        await settled(page);
        const [view, card] = [await at('.view'), await at('.card')];
        assert.ok(card.top >= 0 && card.bottom <= 844, `${how}: the card is at ${card.top} … ${card.bottom}`);
        assert.ok(view.bottom > 200, `${how}: ${view.bottom} px of the map are seen`);
    };
    await press(page, 'd');
    await inSight('the key D');
    await page.click('[data-action="next-defect"]');
    await inSight('the button');
    await page.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
    await page.click('#defect-list tr[data-defect="2"] td:nth-child(3)');
    await inSight('the list');
    await closeReport(page);
});

test('on a phone the pictures are as wide as the page', async () => {
    const page = await openReport(browser, file, { width: 390, height: 844 });
    const widths = await page.$$eval('figure img', (all) => all.map((image) => image.getBoundingClientRect().right));
    assert.ok(widths.length >= 8);
    for (const right of widths) assert.ok(right > 300 && right <= 390, `a picture ends at ${right}`);
    await closeReport(page);
});

test('two fingers zoom', async () => {
    const page = await openReport(browser, file, { width: 390, height: 844 });
    const session = await page.context().newCDPSession(page);
    const { x, y } = await page.locator('.overlay').boundingBox();
    const touch = (type, apart) =>
        session.send('Input.dispatchTouchEvent', {
            type,
            touchPoints:
                apart === null ? [] : [-1, 1].map((side) => ({ x: x + 140 + side * apart, y: y + 150, id: side + 2 })),
        });
    const before_ = await page.locator('.overlay').screenshot();
    const view = await page.getAttribute('.view', 'data-view');
    await touch('touchStart', 30);
    for (const apart of [45, 60, 75, 90]) await touch('touchMove', apart);
    await touch('touchEnd', null);
    await page.waitForTimeout(600);
    assert.equal(await page.getAttribute('.view', 'data-view'), view); // it does not turn
    assert.notDeepEqual(await page.locator('.overlay').screenshot(), before_);
    await closeReport(page);
});
