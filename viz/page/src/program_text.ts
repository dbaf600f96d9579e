// The program's text: bytes with the beginning of each line, so that half a million lines cost no
// strings. What a line holds is data; visibleText() makes of it what can be shown.

const longestShown = 400; // characters

/** Signs that are not seen but change how others are. */
const unseen = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff]/g;

export function visibleText(text: string): string {
    return text.replace(unseen, (sign) => {
        const code = sign.charCodeAt(0);
        if (code < 0x20) return String.fromCharCode(0x2400 + code); // its picture
        if (code === 0x7f) return '\u2421';
        return `[U+${code.toString(16).toUpperCase().padStart(4, '0')}]`;
    });
}

export class ProgramText {
    private readonly starts: Uint32Array;
    private readonly decoder = new TextDecoder('utf-8', { ignoreBOM: true });

    constructor(
        private readonly bytes: Uint8Array,
        readonly lineCount: number,
    ) {
        this.starts = new Uint32Array(lineCount + 1);
        let at = 0;
        for (let line = 0; line < lineCount; ++line) {
            this.starts[line] = at;
            const end = bytes.indexOf(10, at);
            at = end < 0 ? bytes.length : end + 1;
        }
        this.starts[lineCount] = at;
    }

    /** The text of a line (from 1), cut where it is very long. */
    line(number: number): string {
        if (number < 1 || number > this.lineCount) return '';
        const begin = this.starts[number - 1];
        let end = this.starts[number];
        while (end > begin && (this.bytes[end - 1] === 10 || this.bytes[end - 1] === 13)) --end;
        const size = end - begin;
        const text = visibleText(
            this.decoder.decode(this.bytes.subarray(begin, Math.min(end, begin + 4 * longestShown))),
        );
        if (text.length <= longestShown && size <= 4 * longestShown) return text;
        return `${text.slice(0, longestShown)} … ${(size - longestShown).toLocaleString('en')} more bytes`;
    }
}
