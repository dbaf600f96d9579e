// What is drawn over the surface: no label covers a marker, no marker stands behind the title, and the surface has no
// colours that its values do not have.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import {
    checkedBottle,
    clickView,
    closeReport,
    countPixels,
    goTo,
    numbers,
    openReport,
    press,
    reports,
    settled,
    startBrowser,
} from './browser.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser?.close());

const { defects } = checkedBottle();

/** From here on the page notes each picture: boxes of markers, and of texts by what they say. */
async function watchDrawing(page) {
    await page.evaluate(() => {
        const drawn = (window.drawn = { markers: [], texts: [], longest: 0 });
        const overlay = document.querySelector('.overlay');
        const { roundRect, fillText, stroke } = window.CanvasRenderingContext2D.prototype;
        const size = Object.getOwnPropertyDescriptor(window.HTMLCanvasElement.prototype, 'width');
        Object.defineProperty(overlay, 'width', {
            get: () => size.get.call(overlay),
            set(value) {
                drawn.markers.length = drawn.texts.length = drawn.longest = 0; // a new picture begins
                size.set.call(overlay, value);
            },
        });
        window.CanvasRenderingContext2D.prototype.roundRect = function (x, y, width, height, radius) {
            if (this.canvas === overlay)
                drawn.markers.push({ left: x, top: y, right: x + width, bottom: y + height, text: '' });
            return roundRect.call(this, x, y, width, height, radius);
        };
        // Lines along the surface are paths of short pieces.
        const { moveTo, lineTo, closePath } = window.Path2D.prototype;
        const goOn = (path, to) => {
            if (path.at) path.longest = Math.max(path.longest ?? 0, Math.hypot(to[0] - path.at[0], to[1] - path.at[1]));
            path.at = to;
        };
        window.Path2D.prototype.moveTo = function (x, y) {
            this.first = this.at = [x, y];
            return moveTo.call(this, x, y);
        };
        window.Path2D.prototype.lineTo = function (x, y) {
            goOn(this, [x, y]);
            return lineTo.call(this, x, y);
        };
        window.Path2D.prototype.closePath = function () {
            if (this.first) goOn(this, this.first);
            return closePath.call(this);
        };
        window.CanvasRenderingContext2D.prototype.stroke = function (path, ...rest) {
            if (this.canvas === overlay && path) drawn.longest = Math.max(drawn.longest, path.longest ?? 0);
            return path ? stroke.call(this, path, ...rest) : stroke.call(this);
        };
        window.CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
            if (this.canvas === overlay) {
                const { width } = this.measureText(text);
                const left = this.textAlign === 'center' ? x - width / 2 : this.textAlign === 'right' ? x - width : x;
                drawn.texts.push({ text, left, top: y - 7, right: left + width, bottom: y + 7 });
                const marker = drawn.markers.at(-1);
                if (marker && !marker.text && /^\d+$/.test(text)) marker.text = text;
            }
            return fillText.call(this, text, x, y, ...rest);
        };
    });
}

const mostPiece = 30; // px, of a line along the surface

const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
const drawn = (page) => page.evaluate(() => window.drawn);
const names = (boxes) => boxes.map(({ text }) => text);

test('the label of a point covers no marker', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    for (const point of [4848, ...defects.map((defect) => defect.point)]) {
        await goTo(page, 'point', point);
        const { markers, texts } = await drawn(page);
        const label = texts.find(({ text }) => text.startsWith(`point ${point},`));
        assert.ok(markers.length > 5 && label, `point ${point}`);
        assert.deepEqual(names(markers.filter((box) => meet(box, label))), [], `under "${label.text}"`);
    }
    await closeReport(page);
});

test('no marker stands behind the title or another one', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    for (const { id } of defects.map((_, k) => ({ id: k + 1 }))) {
        await press(page, 'd');
        const { markers, texts } = await drawn(page);
        assert.ok(names(markers).includes(String(id)), `defect ${id} has no marker in its own view`);
        const title = texts.filter(({ left }) => left === 12);
        assert.equal(title.length, 2);
        for (const text of title)
            assert.deepEqual(names(markers.filter((box) => meet(box, text))), [], `behind "${text.text}"`);
        markers.forEach((box, k) =>
            assert.deepEqual(names(markers.slice(k + 1).filter((other) => meet(box, other))), [], `on ${box.text}`),
        );
    }
    await closeReport(page);
});

test('a marker without room is moved or counted, and none is lost', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    await press(page, 'h');
    for (let k = 0; k < 6; ++k) {
        const { markers, texts } = await drawn(page);
        const hidden = Number(
            /· (\d+) markers? (does|do) not fit/.exec(texts.map(({ text }) => text).join('\n'))?.[1] ?? 0,
        );
        const inView = k === 0 ? defects.length : markers.length;
        assert.ok(markers.length + hidden >= inView, `${markers.length} markers and ${hidden} hidden`);
        await page.mouse.move(480, 300);
        await page.mouse.wheel(0, 600); // away: they come closer
        await settled(page);
    }
    const { markers, texts } = await drawn(page);
    assert.ok(markers.length < defects.length);
    assert.ok(
        texts.some(({ text }) => text.endsWith(`${defects.length - markers.length} markers do not fit: zoom in`)),
    );
    await closeReport(page);
});

test('places without a value are hatched, and the legend names them only there', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    const isNamed = async () => names((await drawn(page)).texts).includes('no value');
    const choose = async (label) => {
        const fields = await page.$$eval('select[aria-label="field"] option', (all) => all.map((o) => o.textContent));
        await page
            .getByLabel('field', { exact: true })
            .selectOption({ label: fields.find((f) => f.startsWith(label)) });
        await settled(page);
    };
    const greys = () => countPixels(page, page.locator('.view'), (r, g, b) => r === g && g === b && r > 140 && r < 160);
    await choose('Path speed [');
    assert.equal(await isNamed(), false);
    const without = await greys();
    await choose('Speed difference');
    assert.equal(await isNamed(), true);
    assert.ok((await greys()) > without + 200);
    await closeReport(page);
});

test('no line of a defect leaves the surface: it has no chord from one end of a pass to the other', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    for (const { id } of defects.map((_, k) => ({ id: k + 1 }))) {
        await press(page, 'd');
        const { longest } = await drawn(page);
        assert.ok(longest > 0 && longest < mostPiece, `defect ${id}: a piece of ${longest} px`);
    }
    await closeReport(page);
});

test('lengths are measured to a micrometre', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    await press(page, 'm');
    for (const x of [300, 400]) await page.locator('.overlay').click({ position: { x, y: 250 } });
    await settled(page);
    const text = names((await drawn(page)).texts).find((t) => t.includes('ΔX'));
    assert.match(text, /^\d+\.\d{3} mm {3}ΔX −?\d+\.\d{3} {2}ΔY −?\d+\.\d{3} {2}ΔZ −?\d+\.\d{3}$/);
    await closeReport(page);
});

/** The numbers along an edge: what they say, and where they stand in pixels. */
const along = (texts, isThere, middle) =>
    texts
        .filter((text) => /^-?[\d.]+$/.test(text.text) && isThere(text))
        .map((text) => ({ value: Number(text.text), at: middle(text) }));

/** The numbers along the lower and the left edge of the view. */
async function edgesOf(page) {
    const { texts, markers } = await drawn(page);
    const height = await page.locator('.view').evaluate((view) => view.clientHeight);
    const inMarkers = (text) => markers.some((box) => meet(box, text));
    const across = along(
        texts,
        ({ top }) => top > height - 18,
        ({ left, right }) => (left + right) / 2,
    );
    const upward = along(
        texts,
        (text) => text.right < 40 && text.bottom < height - 14 && !inMarkers(text),
        ({ top, bottom }) => (top + bottom) / 2,
    );
    return { across, upward, names: names(texts).filter((text) => /^[XYZ] \[mm/.test(text)) };
}

/** Where a pixel lies by the numbers of its edge. */
function valueAt(numbers_, pixel) {
    const [first, last] = [numbers_[0], numbers_.at(-1)];
    for (const { value, at } of numbers_) {
        const expected = first.at + ((value - first.value) * (last.at - first.at)) / (last.value - first.value);
        assert.ok(Math.abs(at - expected) < 0.5, `${value} is at ${at}, not ${expected}`);
    }
    return first.value + ((pixel - first.at) * (last.value - first.value)) / (last.at - first.at);
}

test('a view along an axis has its millimetres at two edges', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    await press(page, 'i');
    assert.deepEqual((await edgesOf(page)).names, []);
    for (const [key, expected] of [
        ['f', ['X [mm, G54]', 'Z [mm]']],
        ['l', ['Y [mm, G54]', 'Z [mm]']],
        ['t', ['X [mm, G54]', 'Y [mm]']],
    ]) {
        await press(page, key);
        const { names: found, across, upward } = await edgesOf(page);
        assert.deepEqual(found, expected);
        assert.ok(across.length > 2 && upward.length > 2, `${key}: ${across.length} and ${upward.length} numbers`);
    }
    // What is clicked has the coordinates that the edges say, also after the view moved and came closer.
    for (const zoom of [0, -300]) {
        await page.mouse.move(480, 300);
        await page.mouse.wheel(0, zoom);
        await clickView(page, 330, 180);
        const { across, upward } = await edgesOf(page);
        const [x, y] = (await numbers(page))['X Y Z'].match(/-?[\d.]+/g).map(Number);
        assert.ok(Math.abs(valueAt(across, 330) - x) < 0.5, `X is ${x}, not ${valueAt(across, 330)}`);
        assert.ok(Math.abs(valueAt(upward, 180) - y) < 0.5, `Y is ${y}, not ${valueAt(upward, 180)}`);
    }
    const { markers, texts } = await drawn(page);
    for (const text of texts.filter((t) => /^[XYZ] \[mm/.test(t.text)))
        assert.deepEqual(names(markers.filter((box) => meet(box, text))), [], `behind "${text.text}"`);
    await closeReport(page);
});

test('a marker that is clicked shows its defect', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    await press(page, 't');
    for (const text of (await drawn(page)).markers.slice(0, 3).map((marker) => marker.text)) {
        await press(page, 't');
        const box = (await drawn(page)).markers.find((marker) => marker.text === text);
        const position = { x: (box.left + box.right) / 2, y: (box.top + box.bottom) / 2 };
        await page.locator('.overlay').hover({ position });
        assert.equal(await page.getAttribute('.overlay', 'title'), `show defect ${text}`);
        await page.locator('.overlay').click({ position });
        await page.mouse.move(2, 2);
        assert.equal(Number((await numbers(page)).Point), defects[Number(text) - 1].point);
        assert.match(await page.textContent('.card h2'), new RegExp(`^Defect ${text}$`));
    }
    await closeReport(page);
});

/** How many pixels of the view are more green than red, as no colour of magma is; that of values beyond its upper end is. */
async function strangePixels(page) {
    return countPixels(page, page.locator('.view'), (r, g) => g > r + 25);
}

test('edges have no dots in the colour of values that are not there', async () => {
    const page = await openReport(browser, reports.ball);
    assert.equal(await page.getByLabel('colour map').inputValue(), 'magma');
    assert.equal(await strangePixels(page), 0);
    // Where there are values beyond the end their colour is seen.
    await page.getByLabel('upper end of the range').fill('50');
    await page.getByLabel('upper end of the range').press('Enter');
    await settled(page);
    assert.ok((await strangePixels(page)) > 1000);
    await closeReport(page);
});

test('the view of a defect all over the part shows the part, no less', async () => {
    const page = await openReport(browser, reports.ball);
    await watchDrawing(page);
    const barOf = async () => Number.parseFloat((await drawn(page)).texts.find(({ text }) => / mm$/.test(text)).text);
    await press(page, 'h');
    const whole = await barOf();
    for (let k = 0; k < defects.length; ++k) {
        await press(page, 'd');
        assert.ok((await barOf()) <= 2 * whole, `defect ${k + 1}`);
    }
    await closeReport(page);
});
