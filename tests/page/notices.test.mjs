// The licences of the bundle's packages: which packages those are is read from the comments that esbuild puts before
// each file of a bundle that is not made small.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { reports } from './browser.mjs';

const packages = process.env.PAGE_PACKAGES;
const source = path.resolve(import.meta.dirname ?? path.dirname(process.argv[1]), '../../viz/page');
const { build } = createRequire(path.join(packages, 'package.json'))('esbuild');
const notice = fs.readFileSync(path.join(source, 'dist/NOTICE.md'), 'utf8');

/** The names of the packages in the bundle. */
async function bundled() {
    const { outputFiles } = await build({
        entryPoints: [path.join(packages, 'src/main.ts')],
        absWorkingDir: packages,
        bundle: true,
        format: 'iife',
        target: ['es2022'],
        write: false,
        outdir: 'unused',
        loader: { '.css': 'empty' },
        treeShaking: true,
    });
    const names = outputFiles[0].text.matchAll(/^\s*\/\/ node_modules\/((?:@[^/\s]+\/)?[^/\s]+)\//gm);
    return new Set([...names].map((match) => match[1]));
}

test('every bundled package has its version and its licence in NOTICE.md', async () => {
    const names = await bundled();
    assert.ok(names.has('@kitware/vtk.js') && names.has('uplot'), [...names].join(' '));
    const lock = JSON.parse(fs.readFileSync(path.join(source, 'package-lock.json'), 'utf8'));
    for (const name of names) {
        const { version } = lock.packages[`node_modules/${name}`];
        const at = notice.indexOf(`\n## ${name} ${version} (`);
        assert.notEqual(at, -1, `${name} ${version} is missing`);
        const text = notice.slice(at + 1).split('\n## ')[0];
        assert.match(text, /Copyright/, name);
        assert.match(text, /Permission|Redistribution|WTFPL|DO WHAT/, name);
    }
    assert.equal(notice.match(/^## /gm).length, names.size, 'packages that are not bundled any more');
});

test('a written page carries the notices', () => {
    const page = fs.readFileSync(reports.bottle, 'utf8');
    // The script is ASCII: other letters are escaped.
    for (const line of notice.split('\n').filter((text) => /^[\x20-\x7e]+$/.test(text)))
        assert.ok(page.includes(line), line);
});

test('a package without a licence is refused', async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'notices-'));
    fs.mkdirSync(path.join(folder, 'node_modules/bare'), { recursive: true });
    const file = path.join(folder, 'node_modules/bare/index.js');
    fs.writeFileSync(file, '// says nothing of its terms\nexport const a = 1;\n');
    fs.writeFileSync(path.join(folder, 'node_modules/bare/package.json'), '{"version": "1.0.0", "license": "MIT"}');
    const { notices } = await import(pathToFileURL(path.join(source, 'notices.mjs')).href);
    const metafile = { outputs: { 'page.js': { inputs: { [file]: { bytesInOutput: 10 } } } } };
    assert.throws(() => notices(metafile, path.join(folder, 'node_modules')), /bare has neither a licence file/);
    fs.writeFileSync(path.join(folder, 'node_modules/bare/LICENSE'), 'Copyright of somebody\n');
    assert.match(
        notices(metafile, path.join(folder, 'node_modules')),
        /## bare 1\.0\.0 \(MIT\)\n\n```\nCopyright of somebody/,
    );
    fs.rmSync(folder, { recursive: true });
});
