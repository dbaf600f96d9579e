// Elements from code. Text goes in as text, never as HTML.

type Children = (Node | string)[];

export function element<K extends keyof HTMLElementTagNameMap>(
    name: K,
    attributes: Record<string, string> = {},
    ...children: Children
): HTMLElementTagNameMap[K] {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
}

export function baseName(path: string): string {
    return path.slice(path.lastIndexOf('/') + 1);
}

/** A page cannot write files: the browser saves it where downloads go. */
export function saveFile(name: string, content: Blob): void {
    const url = URL.createObjectURL(content);
    element('a', { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** The value of a custom property of the style sheet. */
export function styleValue(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** Calls `f` once before the next picture, however often it is asked for. */
export function oncePerFrame(f: () => void): () => void {
    let asked = false;
    return () => {
        if (asked) return;
        asked = true;
        requestAnimationFrame(() => {
            asked = false;
            f();
        });
    };
}

/** Calls `f` once nothing has asked for it for so long [ms]. */
export function afterRest(rest: number, f: () => void): () => void {
    let timer = 0;
    return () => {
        clearTimeout(timer);
        timer = window.setTimeout(f, rest);
    };
}

export function numberText(value: number, digits = 5): string {
    if (!Number.isFinite(value)) return '–';
    const size = Math.abs(value);
    if (size !== 0 && (size >= 1e7 || size < 1e-4)) return value.toPrecision(digits);
    return String(Number(value.toPrecision(Math.max(digits, Math.floor(Math.log10(size || 1)) + 1))));
}
