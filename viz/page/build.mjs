// Builds src/ to dist/page.js, dist/page.css and dist/NOTICE.md (or to the folder named as argument). The same sources
// and lockfile always give the same bytes.
import { build } from 'esbuild';
import { readFileSync, writeFileSync } from 'node:fs';
import { notices } from './notices.mjs';

const folder = process.argv[2] ?? 'dist';
const result = await build({
    entryPoints: { page: 'src/main.ts' },
    outdir: folder,
    bundle: true,
    minify: true,
    format: 'iife',
    target: ['es2022'],
    charset: 'ascii', // bytes that any charset reads the same
    legalComments: 'none', // the notices below are whole
    metafile: true,
    logLevel: 'warning',
});

// The licences ask that their notices go where the code goes: into the script, and so into every page that holds it.
const text = notices(result.metafile, 'node_modules');
const ascii = text.replace(/[^\x00-\x7f]/g, (c) => `\\u${c.codePointAt(0).toString(16).padStart(4, '0')}`);
if (ascii.includes('*/')) throw new Error('a notice holds the end of a comment');
const script = `${folder}/page.js`;
writeFileSync(script, `/*!\n${ascii}*/\n${readFileSync(script, 'utf8')}`);
writeFileSync(`${folder}/NOTICE.md`, text);
