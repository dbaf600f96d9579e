// What a reader chose once and finds again in the next report, where the browser keeps it.

const keysName = 'clsurf.one-letter-keys';

export function rememberedKeys(): boolean {
    try {
        return localStorage.getItem(keysName) !== 'off';
    } catch {
        return true; // a browser may forbid a page from a disk to remember
    }
}

export function rememberKeys(on: boolean): void {
    try {
        localStorage.setItem(keysName, on ? 'on' : 'off');
    } catch {
        // it holds until the page is closed
    }
}
