// SPDX-License-Identifier: MIT
// Colours that people with any colour vision can tell apart: viridis for quantities, Okabe and Ito's for kinds.

export type Rgb = [number, number, number];

const viridis = [
    "440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725",
].map(parse);

function parse(hex: string): Rgb {
    return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255) as Rgb;
}

export function css(colour: Rgb): string {
    return `rgb(${colour.map((c) => Math.round(255 * c)).join(",")})`;
}

/** The part of the ramp that stands out from the ground. */
export function ramp(share: number, dark: boolean): Rgb {
    const at = (dark ? 0.18 + 0.82 * share : 0.9 * share) * (viridis.length - 1);
    const i = Math.min(Math.max(Math.floor(at), 0), viridis.length - 2);
    const part = Math.min(Math.max(at - i, 0), 1);
    return viridis[i].map((c, k) => c + part * (viridis[i + 1][k] - c)) as Rgb;
}

const axes: Record<string, string> = {
    x: "d55e00", y: "009e73", z: "2b7fd0", a: "cc79a7", b: "e69f00", c: "56b4e9",
};
const spare = Object.values(axes);

export function axisColour(name: string, index: number): string {
    return `#${axes[name.toLowerCase()] ?? spare[index % spare.length]}`;
}

// By LimitKind of limit_kind.hpp: none, feed, machine's feed, velocity, acceleration, jerk, centripetal, chord, override, hold, dwell.
const kinds = ["9aa0a6", "56b4e9", "0072b2", "009e73", "e69f00", "cc79a7", "d55e00", "b8a800", "7a5cd0", "e8d81c", "6b5344"].map(parse);
export const limitCodes = 8 * kinds.length;

/** Of a limit, by its code; axes of one kind differ in brightness. */
export function limitColour(code: number): Rgb {
    const axis = code & 7;
    const shade = [0, -0.28, 0.38, -0.5, 0.6, -0.65][axis] ?? 0;
    return kinds[code >> 3].map((c) => (shade < 0 ? c * (1 + shade) : c + shade * (1 - c))) as Rgb;
}

/** Steps of 1, 2 or 5 powers of ten, at most `most` in the span. */
export function niceStep(span: number, most: number): number {
    const least = span / Math.max(most, 1);
    if (!(least > 0)) return 1;
    const power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((f) => f * power).find((step) => step >= least * 0.9999) ?? 10 * power;
}

export function number(value: number, digits = 4): string {
    if (!Number.isFinite(value)) return "-";
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-4 || size >= 1e7)) return value.toExponential(Math.max(digits - 2, 0));
    const decimals = size === 0 ? 0 : Math.min(Math.max(digits - 1 - Math.floor(Math.log10(size)), 0), 6);
    return value.toFixed(decimals);
}

/** Of a scale with this step: no more decimals than it needs. */
export function tick(value: number, step: number): string {
    return String(Number(value.toFixed(Math.max(0, 1 - Math.floor(Math.log10(step))))));
}

export function duration(seconds: number): string {
    if (!Number.isFinite(seconds)) return "-";
    if (seconds < 60) return `${number(seconds)} s`;
    const whole = Math.round(seconds);
    const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
    return h ? `${h} h ${String(m).padStart(2, "0")} min ${String(s).padStart(2, "0")} s` : `${m} min ${String(s).padStart(2, "0")} s`;
}
