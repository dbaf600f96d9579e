// The command line that the page shows draws the same picture: where the surface lies, and its colours.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

import { clsurf, countPixels, folder, press, reports, settled, useReport } from './browser.mjs';

let page;
useReport(
    () => reports.ball,
    (opened) => (page = opened),
);

/** Fractions of the map's pixels that both pictures have the same: surface or not, and its colour. */
async function agreement(blank, ours, theirs, map) {
    const url = (file) => `data:image/png;base64,${fs.readFileSync(file).toString('base64')}`;
    return blank.evaluate(
        async ({ ours, theirs, map }) => {
            const pixels = async (url, x, y) => {
                const image = new Image();
                image.src = url;
                await image.decode();
                const canvas = document.createElement('canvas');
                [canvas.width, canvas.height] = [map.width, map.height];
                const g = canvas.getContext('2d');
                g.drawImage(image, -x, -y);
                return g.getImageData(0, 0, map.width, map.height).data;
            };
            const a = await pixels(ours, 0, 0);
            const b = await pixels(theirs, 0, map.top);
            let [count, covered, both, coloured] = [0, 0, 0, 0];
            for (let i = 0; i < a.length; i += 4) {
                ++count;
                const white = (p) => p[i] > 245 && p[i + 1] > 245 && p[i + 2] > 245;
                covered += white(a) === white(b);
                if (white(a) || white(b)) continue;
                ++both;
                // Light falls otherwise: colours are compared at the same brightness.
                const most = (p) => Math.max(p[i], p[i + 1], p[i + 2]);
                const far = [0, 1, 2].some((k) => Math.abs(p0(a, i, k, most) - p0(b, i, k, most)) > 0.12);
                coloured += !far;
            }
            function p0(p, i, k, most) {
                return p[i + k] / most(p);
            }
            return { covered: covered / count, coloured: coloured / both, both: both / count };
        },
        { ours: url(ours), theirs: url(theirs), map },
    );
}

const cases = {
    'isometric view, whole': async () => press(page, 'i'),
    'from above, enlarged': async () => {
        await press(page, 't');
        await page.mouse.move(480, 300);
        await page.mouse.wheel(0, -700);
    },
    'turned, moved, another field, map and range': async () => {
        await press(page, 'i');
        await page.mouse.move(480, 300);
        await page.mouse.down();
        await page.mouse.move(430, 330, { steps: 3 });
        await page.mouse.up();
        await page.keyboard.down('Shift');
        await page.mouse.down();
        await page.mouse.move(470, 350, { steps: 3 });
        await page.mouse.up();
        await page.keyboard.up('Shift');
        await page.getByLabel('field').selectOption({ label: 'Height over the commanded surface [µm]' });
        await page.getByLabel('colour map').selectOption('cividis');
        await page.getByLabel('upper end').fill('45');
        await page.getByLabel('upper end').press('Enter');
    },
    'the as-machined surface': async () => {
        await press(page, 'i');
        await page.locator('.choices button', { hasText: 'formed' }).click();
        await press(page, 'h');
    },
};

/** No colour of magma, but the lighter tone of its dark end. */
const isPale = (r, g, b) => r > 120 && r < 195 && Math.abs(r - g) < 25 && r - b > 12 && r - b < 60;

test('ramps at the ends of passes have a lighter tone, in the view and in the picture', async () => {
    await press(page, 'i');
    assert.ok((await page.getByLabel('field', { exact: true }).inputValue()) === '0');
    const pale = await countPixels(page, page.locator('.layer'), isPale);
    const picture = page.locator('#maps img[alt^="Path speed"]');
    const pictured = await countPixels(page, picture, isPale);
    assert.ok(pale > 80, `${pale} pixels`);
    assert.ok(pictured > 250, `${pictured} pixels`);
});

for (const [name, prepare] of Object.entries(cases)) {
    test(name, async () => {
        await prepare();
        await settled(page);
        await press(page, 'r');
        const command = await page.getByLabel('command line').inputValue();
        await page.keyboard.press('Escape');
        const theirs = path.join(folder, 'render.png');
        // As a user would: pasted into a shell.
        execFileSync('bash', [
            '-c',
            `${command.replace(/^clsurf /, `'${clsurf}' `).replace('-o map.png', `-o '${theirs}'`)} -q`,
        ]);
        const ours = path.join(folder, 'layer.png');
        const size = await page.evaluate(() => {
            document.querySelector('.overlay').style.visibility = 'hidden';
            const { clientWidth, clientHeight } = document.querySelector('.layer');
            return [clientWidth, clientHeight];
        });
        await page.locator('.layer').screenshot({ path: ours });
        await page.evaluate(() => (document.querySelector('.overlay').style.visibility = ''));
        const [, height] = /--size (\d+)x(\d+)/.exec(command).slice(1).map(Number);
        const text = Math.min(60, Math.max(9, Math.min(0.75 * Number(/--size (\d+)x/.exec(command)[1]), height) / 46));
        const map = {
            width: size[0],
            height: size[1],
            top: height - size[1] - Math.round(3 * Math.max(8, 0.78 * text)),
        };
        const blank = await page.context().browser().newPage();
        const same = await agreement(blank, ours, theirs, map);
        await blank.close();
        // Marks and the scale bar lie on the map that render makes, edges are smoothed otherwise.
        assert.ok(same.both > 0.15, JSON.stringify(same));
        // The as-machined surface is sampled anew for each picture, and by how much its ragged border reaches out the whole is
        // drawn larger or smaller.
        const formed = name === 'the as-machined surface';
        assert.ok(same.covered > (formed ? 0.88 : 0.985), JSON.stringify(same));
        assert.ok(same.coloured > (formed ? 0.8 : 0.9), JSON.stringify(same));
    });
}
