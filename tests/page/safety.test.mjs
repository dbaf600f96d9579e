// Program text, comments and file names are data: whatever they hold is shown and does nothing.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

import { bottle, folder, goTo, run, useReport } from './browser.mjs';

const hostile = [
    '(</script><script>window.harmed = 1</script>)',
    '(<img src=x onerror="window.harmed = 1">)',
    '("quotes\' and `ticks` & &lt;entities&gt; ${window.harmed = 1})',
    '(<!-- <script> ]]> --!>)',
    Buffer.concat([
        Buffer.from('(control \x01\x07\x1b[31m\x7f '),
        Buffer.from([0xff, 0xfe, 0xc0, 0xaf]),
        Buffer.from(' no UTF-8)'),
    ]),
    '(turned \u202e txet \u202c and \u2066 marks \u2069 \u200f)',
    '(separators \u2028 \u2029 \ufeff)',
    `(${'long '.repeat(2_000_000)})`, // 10 MB
    '(after the long line)',
];

let page, first;
useReport(
    () => {
        const text = fs.readFileSync(bottle.program);
        first = text.toString('latin1').split('\n').length;
        const program = path.join(folder, `"><img src=x onerror=window.harmed=1> \u202e'$(touch harmed).nc`);
        const log = path.join(folder, '<script>window.harmed=1<\u2044script>.biip');
        fs.writeFileSync(
            program,
            Buffer.concat([text, ...hostile.flatMap((line) => [Buffer.from(line), Buffer.from('\n')])]),
        );
        fs.copyFileSync(bottle.log, log);
        run('report', program, log, '-o', 'hostile.html', '--tool', 'none', '-q');
        return path.join(folder, 'hostile.html');
    },
    (opened) => (page = opened),
);

const line = async (number) => {
    await goTo(page, 'line', number);
    return page.textContent(`.program .row[data-line="${number}"] code`);
};

test('nothing that the text holds is run', async () => {
    assert.equal(await page.evaluate(() => window.harmed), undefined);
    assert.equal(await page.locator('img[src="x"]').count(), 0);
    // One policy, two kinds of data blocks, one script.
    const scripts = await page.$$eval('script', (all) => all.map((s) => s.type));
    assert.equal(scripts.filter((type) => type === '').length, 1);
    assert.ok(scripts.every((type) => ['', 'application/json', 'application/octet-stream'].includes(type)));
});

test('lines are shown as they are', async () => {
    assert.equal(await line(first), hostile[0]);
    assert.equal(await line(first + 1), hostile[1]);
    assert.equal(await line(first + 2), hostile[2]);
    assert.equal(await line(first + 3), hostile[3]);
});

test('control characters, marks and bytes that are no UTF-8 are visible signs', async () => {
    assert.equal(await line(first + 4), '(control \u2401\u2407\u241b[31m\u2421 \ufffd\ufffd\ufffd\ufffd no UTF-8)');
    assert.equal(await line(first + 5), '(turned [U+202E] txet [U+202C] and [U+2066] marks [U+2069] [U+200F])');
    assert.equal(await line(first + 6), '(separators [U+2028] [U+2029] [U+FEFF])');
});

test('a line of 10 MB is cut, and what follows is right', async () => {
    const text = await line(first + 7);
    assert.ok(text.length < 500 && text.endsWith('more bytes'), text.slice(-60));
    assert.equal(await line(first + 8), '(after the long line)');
    const [name] = Object.entries(await page.evaluate(() => ({ title: document.title })))[0];
    assert.equal(name, 'title');
});

test('file names are shown', async () => {
    const title = await page.locator('#summary h1').textContent();
    assert.ok(title.includes(`"><img src=x onerror=window.harmed=1> [U+202E]'$(touch harmed).nc`), title);
    assert.ok(title.includes('<script>window.harmed=1<\u2044script>.biip'), title);
});

test('the command line quotes them, so that a shell takes them as names', async () => {
    await page.click('[data-action="command"]');
    const command = await page.getByLabel('command line').inputValue();
    assert.ok(command.includes(`'\\''$(touch harmed).nc'`), command);
    await page.keyboard.press('Escape');
});

test('the policy forbids every request', async () => {
    const blocked = await page.evaluate(async () => {
        const tried = [];
        await fetch('https://example.invalid/').catch(() => tried.push('fetch'));
        const image = new Image();
        await new Promise((resolve) => {
            image.onerror = resolve;
            image.src = 'https://example.invalid/x.png';
        });
        tried.push('image');
        try {
            new Function('return 1')();
        } catch {
            tried.push('eval');
        }
        return tried;
    });
    assert.deepEqual(blocked, ['fetch', 'image', 'eval']);
    // The browser says what it refused; nothing left it.
    const refused = /Content Security Policy|^asks for https:\/\/example\.invalid\/x\.png$/;
    assert.ok(
        page.complaints.every((text) => refused.test(text)),
        page.complaints.join('\n'),
    );
    page.complaints.length = 0;
});
