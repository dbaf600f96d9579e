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
    legalComments: 'none', // licences of what is bundled: NOTICE.md
    logLevel: 'warning',
    loader: { '.svg': 'text' },
});
process.exitCode = result.errors.length > 0 ? 1 : 0;
