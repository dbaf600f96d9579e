// The licence notices of the packages that a bundle holds, from the packages themselves.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** The packages with code in the bundle, sorted by name: name → its bundled files. */
export function bundledPackages(metafile) {
    const packages = new Map();
    for (const output of Object.values(metafile.outputs)) {
        for (const [file, { bytesInOutput }] of Object.entries(output.inputs)) {
            const name = /(?:^|\/)node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];
            if (name && bytesInOutput > 0) packages.set(name, [...(packages.get(name) ?? []), file]);
        }
    }
    return new Map([...packages].sort(([a], [b]) => (a < b ? -1 : 1)));
}

/** The comments before the first code of a file, without their marks. */
function headComment(file) {
    const text = readFileSync(file, 'utf8');
    const head = /^(?:\s*(?:\/\*[\s\S]*?\*\/|\/\/[^\n]*))*/.exec(text)?.[0] ?? '';
    return head.replace(/^\s*(?:\/\*+|\*+\/|\*|\/\/) ?|\s*\*+\/\s*$/gm, '');
}

/** The licence of a package: its licence file, else what the heads of its bundled files say. Throws where that is nothing. */
function licenceOf(name, folder, files) {
    const licence = readdirSync(folder).find((entry) => /^(licen[cs]e|copying)(\.(md|txt))?$/i.test(entry));
    if (licence) return readFileSync(join(folder, licence), 'utf8');
    const heads = files.map(headComment).filter((head) => /copyright/i.test(head));
    if (heads.length === 0) throw new Error(`${name} has neither a licence file nor a licence in ${files.join(', ')}`);
    return [...new Set(heads.map((head) => head.trim()))].join('\n\n');
}

/** The text of NOTICE.md. */
export function notices(metafile, modules) {
    let text =
        '# Licences of the packages in page.js\n\n' +
        'page.js, and every page that `clsurf report` writes, hold code of these packages. Written by build.mjs.\n';
    for (const [name, files] of bundledPackages(metafile)) {
        const folder = join(modules, name);
        const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
        const lines = licenceOf(name, folder, files)
            .trim()
            .split(/\r?\n/)
            .map((line) => line.trimEnd());
        text += `\n## ${name} ${version} (${license})\n\n\`\`\`\n${lines.join('\n')}\n\`\`\`\n`;
    }
    return text;
}
