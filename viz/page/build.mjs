// Builds src/ to dist/page.js and dist/page.css (or to the folder named as argument). The same sources
// and lockfile always give the same bytes.
import { build } from 'esbuild';

const folder = process.argv[2] ?? 'dist';
const result = await build({
    entryPoints: { page: 'src/main.ts' },
    outdir: folder,
    bundle: true,
    minify: true,
    format: 'iife',
    target: ['es2022'],
    charset: 'ascii', // bytes that any charset reads the same
    legalComments: 'none',
    banner: { js: '/* Holds vtk.js (BSD-3-Clause, (c) Kitware Inc.), uPlot (MIT, (c) Leon Sorokin), gl-matrix, D3 and others: viz/page/NOTICE.md of clsurf */' },
    logLevel: 'warning',
});
process.exitCode = result.errors.length > 0 ? 1 : 0;
