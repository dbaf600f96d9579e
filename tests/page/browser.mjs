// What the page's tests share: reports written by the built program, and a headless Chromium to look at
// them with. A page that logs an error, throws or asks for anything outside itself fails its test.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { after, before } from 'node:test';

export const clsurf = process.env.CLSURF;
export const data = process.env.SAMPLE_DATA;
export const logs = process.env.SAMPLE_LOGS;
export const folder = path.join(process.env.PAGE_FOLDER, path.basename(process.argv[1]).split('.')[0]);
const { chromium } = createRequire(path.join(process.env.PAGE_PACKAGES, 'package.json'))('playwright-core');

export const bottle = { program: `${data}/programs/bottle_uneven.nc`, log: `${logs}/bottle_uneven.biip` };

/** Reports that several files look at (reports.mjs). */
export const reports = {
    bottle: path.join(process.env.PAGE_FOLDER, 'reports/bottle.html'),
    ball: path.join(process.env.PAGE_FOLDER, 'reports/ball.html'), // of a stated tool
};

/** What `check` says of the same run as reports.bottle. */
export function checkedBottle() {
    return JSON.parse(fs.readFileSync(path.join(process.env.PAGE_FOLDER, 'reports/bottle.json'), 'utf8'));
}

fs.mkdirSync(folder, { recursive: true });

/** Runs clsurf and returns what it says. */
export function run(...words) {
    return execFileSync(clsurf, words, {
        encoding: 'utf8',
        maxBuffer: 1 << 28,
        cwd: folder,
        stdio: ['ignore', 'pipe', 'inherit'],
    });
}

export function writeReport(name, { program, log }, ...options) {
    const file = path.join(folder, name);
    run('report', program, log, '-o', file, '-q', ...options);
    return file;
}

export async function startBrowser() {
    return chromium.launch({
        executablePath: process.env.CHROMIUM,
        args: [
            '--no-sandbox',
            '--no-first-run',
            '--disable-quic',
            '--disable-background-networking',
            '--disable-component-update',
            '--use-angle=gl-egl', // Mesa's software, which keeps compiled shaders from page to page
            '--ignore-gpu-blocklist',
            '--disable-gpu-compositing', // software draws the view; what is around it goes no way through the same
            '--font-render-hinting=none',
        ],
    });
}

/** Opens a report; `page.complaints` gathers what must not happen. */
export async function openReport(
    browser,
    file,
    { width = 1280, height = 800, colorScheme = 'light', javaScriptEnabled = true } = {},
) {
    const context = await browser.newContext({
        viewport: { width, height },
        colorScheme,
        javaScriptEnabled,
        acceptDownloads: true,
    });
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    page.complaints = [];
    page.on(
        'console',
        (message) =>
            ['error', 'warning'].includes(message.type()) &&
            !message.text().includes('GPU stall') &&
            page.complaints.push(message.text()),
    );
    page.on('pageerror', (error) => page.complaints.push(String(error)));
    page.on(
        'request',
        (request) =>
            /^(data|blob):/.test(request.url()) ||
            request.url() === `file://${encodeURI(file)}` ||
            page.complaints.push(`asks for ${request.url()}`),
    );
    page.on('dialog', (dialog) => page.complaints.push(`opens a dialog: ${dialog.message()}`));
    await page.goto(`file://${encodeURI(file)}`);
    if (javaScriptEnabled) {
        await page.waitForFunction(
            () => document.documentElement.dataset.ready === 'yes' || document.querySelector('#app.failed'),
            null,
            { timeout: 300_000 },
        );
        await settled(page);
    }
    return page;
}

export async function closeReport(page) {
    assert.deepEqual(page.complaints, []);
    await page.context().close();
}

/** Writes a report before the tests of a file, or names a shared one, gives them its page, and looks at its complaints after them. */
export function useReport(write, take) {
    let browser, page;
    before(async () => {
        const file = write();
        browser = await startBrowser();
        page = await openReport(browser, file);
        take(page);
    });
    after(async () => {
        try {
            if (page) await closeReport(page);
        } finally {
            await browser?.close(); // else the test never ends
        }
    });
}

/** Two frames on: what was asked for is drawn. */
export async function settled(page) {
    await page.evaluate(
        () =>
            new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve, 30)))),
    );
}

/** The rows of the table of numbers, by their names. */
export async function numbers(page) {
    await settled(page);
    const rows = await page.$$eval('.table tr', (all) =>
        all.map((row) => [row.querySelector('th').textContent, row.querySelector('td').textContent]),
    );
    return Object.fromEntries(rows);
}

/** Clicks into the view and takes the pointer away, so that the numbers are the cursor's. */
export async function clickView(page, x, y) {
    await page.locator('.overlay').click({ position: { x, y } });
    await page.mouse.move(2, 2);
    await settled(page);
}

export async function goTo(page, kind, value) {
    await page.getByLabel('target', { exact: true }).selectOption(kind);
    await page.getByLabel('go to', { exact: true }).fill(String(value));
    await page.getByLabel('go to', { exact: true }).press('Enter');
    await settled(page);
}

export async function press(page, key) {
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press(key);
    await settled(page);
}

export async function pressed(page, name) {
    return (await page.getAttribute(`[data-action="${name}"]`, 'aria-pressed')) === 'true';
}

export async function chosenLine(page) {
    return Number(await page.getAttribute('.program .row.chosen', 'data-line'));
}

/** How many pixels of an element's picture have red, green and blue as `counts` wants them. */
export async function countPixels(page, locator, counts) {
    const shot = (await locator.screenshot()).toString('base64');
    const text = await page.evaluate(async (data) => {
        const image = new Image();
        image.src = `data:image/png;base64,${data}`;
        await image.decode();
        const canvas = document.createElement('canvas');
        [canvas.width, canvas.height] = [image.width, image.height];
        const g = canvas.getContext('2d');
        g.drawImage(image, 0, 0);
        const { data: rgba } = g.getImageData(0, 0, image.width, image.height);
        let bytes = '';
        for (let i = 0; i < rgba.length; i += 32768) bytes += String.fromCharCode(...rgba.subarray(i, i + 32768));
        return btoa(bytes);
    }, shot);
    const rgba = Buffer.from(text, 'base64');
    let found = 0;
    for (let i = 0; i < rgba.length; i += 4) if (counts(rgba[i], rgba[i + 1], rgba[i + 2])) ++found;
    return found;
}

/** Compares a screenshot with its baseline by `clsurf compare`: on the mean, since letters are drawn otherwise elsewhere, and the
 * list of defects may be scrolled by a few rows, which is up to 0.007. */
export async function comparePicture(page, name, most = 0.012) {
    const made = path.join(folder, `${name}.png`);
    const baseline = path.join(process.env.PAGE_BASELINE, `${name}.png`);
    await settled(page);
    await page.screenshot({ path: made });
    if (process.env.PAGE_UPDATE) fs.copyFileSync(made, baseline);
    assert.ok(fs.existsSync(baseline), `${baseline} is missing; look at ${made}`);
    return compareFiles(made, baseline, most);
}

export function compareFiles(made, baseline, most) {
    let text;
    try {
        text = execFileSync(clsurf, ['compare', made, baseline, '--json'], {
            encoding: 'utf8',
            stdio: ['ignore', 'pipe', 'ignore'],
        });
    } catch (error) {
        assert.equal(error.status, 1, String(error));
        text = error.stdout;
    }
    const { mean_error } = JSON.parse(text);
    assert.ok(mean_error <= most, `${made} differs from ${baseline}: mean error ${mean_error}, allowed ${most}`);
    return mean_error;
}
