// What eslint looks for in the page's sources: mistakes and length, not layout (that is prettier's).
import js from '@eslint/js';
import tseslint from 'typescript-eslint';

export default tseslint.config(
    { ignores: ['dist/', 'node_modules/'] },
    js.configs.recommended,
    { rules: { 'no-control-regex': 'off' } }, // control characters are looked for by their codes
    { rules: { 'max-lines': ['error', 500], 'max-lines-per-function': ['error', 60] } }, // as in C++
    {
        files: ['**/*.ts'],
        extends: [tseslint.configs.recommendedTypeChecked],
        languageOptions: { parserOptions: { project: './tsconfig.json' } },
        rules: {
            eqeqeq: 'error',
            'no-var': 'error',
            'prefer-const': 'error',
            '@typescript-eslint/no-misused-promises': ['error', { checksVoidReturn: { arguments: false } }], // listeners
            '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
        },
    },
    {
        files: ['**/*.mjs'],
        languageOptions: {
            globals: Object.fromEntries(
                // Of Node, and of the page in what the tests run there.
                ['process', 'console', 'Buffer', 'URL', 'document', 'window', 'fetch', 'Image', 'HTMLElement']
                    .concat([
                        'getComputedStyle',
                        'setTimeout',
                        'navigator',
                        'requestAnimationFrame',
                        'MouseEvent',
                        'innerWidth',
                        'innerHeight',
                        'btoa',
                    ])
                    .map((name) => [name, 'readonly']),
            ),
        },
    },
);
