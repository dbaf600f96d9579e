// Numbers with a fixed number of decimals, as the reports of clsurf have them. None is −0.

/** "-12.500", "0.000" */
export function fixedText(value: number, decimals: number): string {
    const text = value.toFixed(decimals);
    return Number(text) === 0 ? text.replace('-', '') : text;
}

/** The same with its sign: "+12.500", "-12.500", "+0.000" */
export function signedText(value: number, decimals: number): string {
    const text = fixedText(value, decimals);
    return text.startsWith('-') ? text : `+${text}`;
}
