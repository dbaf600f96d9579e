// What opens over the page: the command line, the keys.

import type { Action } from './actions';
import { element } from './dom';
import type { Store } from './store';

function open(title: string, ...children: Node[]): void {
    document.querySelector('dialog')?.remove();
    const close = element('button', { 'data-action': 'close', title: 'close (key Escape)' }, 'Close');
    const dialog = element('dialog', {}, element('h2', {}, title), ...children, element('p', {}, close));
    close.addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
}

export function showCommand(command: string): void {
    const text = element('textarea', { readonly: '', rows: '5', 'aria-label': 'command line' });
    text.value = command;
    const copy = element('button', { 'data-action': 'copy', title: 'copy to the clipboard' }, 'Copy');
    copy.addEventListener('click', async () => {
        text.select();
        try {
            await navigator.clipboard.writeText(command);
            copy.textContent = 'Copied';
        } catch {
            copy.textContent = 'Selected: copy with Ctrl+C'; // a page from a file may not write the clipboard
        }
    });
    open('This view, drawn by clsurf', text, element('p', {}, copy));
    text.select();
}

export function showKeys(actions: Action[], store: Store): void {
    const rows = actions.map((a) =>
        element('tr', {}, element('td', {}, element('kbd', {}, a.key.toUpperCase())), element('td', {}, a.title)),
    );
    const pointer = [
        ['drag', 'turn'],
        ['shift and drag, or the right button', 'move'],
        ['wheel', 'zoom'],
        ['double click', 'show the whole part'],
        ['arrow keys, in the view', 'turn'],
        ['shift and arrow keys, in the view', 'move'],
        ['+ and −, in the view', 'zoom'],
        ['click', 'select the place, its line and its point on the curves'],
    ].map(([what, does]) => element('tr', {}, element('td', {}, what), element('td', {}, does)));
    const on = element('input', { type: 'checkbox', name: 'keys' });
    on.checked = store.state.keys;
    on.addEventListener('change', () => store.set({ keys: on.checked }));
    open(
        'Keys',
        element('p', {}, element('label', {}, on, ' One-letter keys are on')),
        element(
            'div',
            { class: 'keys', tabindex: '0' },
            element('table', {}, element('tbody', {}, ...rows)),
            element('table', {}, element('tbody', {}, ...pointer)),
        ),
    );
}
