// The page as a picture: both themes, both usual sizes, on paper, and without JavaScript.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';

import {
    clickView,
    closeReport,
    comparePicture,
    folder,
    goTo,
    openReport,
    press,
    reports,
    startBrowser,
} from './browser.mjs';

let browser, file;
before(async () => {
    file = reports.ball;
    browser = await startBrowser();
});
after(() => browser.close());

/** What is cut off: text wider than its box, panes outside the window. */
async function clipped(page) {
    return page.evaluate(() => {
        const found = [];
        if (document.documentElement.scrollWidth > innerWidth) found.push('the page is wider than the window');
        for (const button of document.querySelectorAll(
            '.toolbar button, .choices button, .range button, #summary dd',
        )) {
            if (button.scrollWidth > button.clientWidth + 1 && button.tagName === 'BUTTON')
                found.push(button.textContent);
        }
        for (const name of ['toolbar', 'side', 'view', 'program', 'curves', 'table']) {
            const box = document.querySelector(`.${name}`).getBoundingClientRect();
            if (box.right > innerWidth + 1 || box.bottom > innerHeight + 1 || box.width < 100 || box.height < 30)
                found.push(name);
        }
        return found;
    });
}

for (const [name, width, height, colorScheme] of [
    ['light_1280', 1280, 800, 'light'],
    ['dark_1280', 1280, 800, 'dark'],
    ['light_1920', 1920, 1080, 'light'],
]) {
    test(name, async () => {
        const page = await openReport(browser, file, { width, height, colorScheme });
        assert.deepEqual(await clipped(page), []);
        await goTo(page, 'point', 4848);
        await comparePicture(page, name);
        await closeReport(page);
    });
}

test('a defect enlarged', async () => {
    const page = await openReport(browser, file);
    await press(page, 't');
    await page.click('[data-choice="defect-7"]');
    await page.mouse.move(2, 2);
    await comparePicture(page, 'defect');
    await closeReport(page);
});

test('the as-machined surface', async () => {
    const page = await openReport(browser, file);
    await page.locator('.choices button', { hasText: 'formed' }).click();
    await page.mouse.move(2, 2);
    await comparePicture(page, 'formed');
    await clickView(page, 300, 250);
    await closeReport(page);
});

test('without JavaScript summary, pictures and tables are there', async () => {
    const page = await openReport(browser, file, { javaScriptEnabled: false });
    assert.ok(!(await page.locator('#app').isVisible()));
    assert.ok((await page.locator('noscript').count()) === 1);
    const summary = await page.locator('#summary').innerText();
    assert.match(summary, /bottle_uneven\.nc/);
    assert.match(summary, /clsurf \d+\.\d+\.\d+/);
    assert.match(summary, /Tool\s+ball:6/);
    assert.ok((await page.locator('#defect-list tbody tr').count()) > 10);
    assert.ok((await page.locator('figure img').count()) >= 8);
    for (const image of await page.locator('figure img').all())
        assert.ok(await image.evaluate((i) => i.naturalWidth > 400));
    await page.screenshot({ path: path.join(folder, 'static.png'), fullPage: true });
    await closeReport(page);
});

test('the defect map comes first, and pictures are as large as they are drawn', async () => {
    const page = await openReport(browser, file);
    const pictures = await page.$$eval('figure img', (all) =>
        all.map((image) => ({ alt: image.alt, width: image.clientWidth, drawn: image.naturalWidth })),
    );
    assert.equal(pictures[0].alt, 'Defects');
    for (const { alt, width, drawn } of pictures) assert.ok(width > 0.95 * drawn, `${alt}: ${width} of ${drawn}`);
    await closeReport(page);
});

test('on paper the panes give way to pictures and tables', async () => {
    const page = await openReport(browser, file);
    await page.emulateMedia({ media: 'print' });
    assert.ok(!(await page.locator('#app').isVisible()));
    assert.ok(await page.locator('#maps img').first().isVisible());
    const paper = { width: 718, height: 1046 }; // A4 less margins of 1 cm, in CSS pixels
    await page.setViewportSize(paper);
    for (const table of await page.locator('#report table').all()) {
        const { x, width } = await table.boundingBox();
        assert.ok(
            x + width <= paper.width,
            `a table is ${Math.round(x + width - paper.width)} pixels wider than the sheet`,
        );
    }
    fs.writeFileSync(path.join(folder, 'report.pdf'), await page.pdf({ format: 'A4' }));
    await closeReport(page);
});
