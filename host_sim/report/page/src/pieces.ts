// SPDX-License-Identifier: MIT
// The path in pieces of one colour each: those of the report, divided where the strips know more.
import { limitCodes, limitColour, ramp, type Rgb } from "./colour";
import { before, Kind, type Motion } from "./motion";

export type Quantity = "speed" | "feed" | "acceleration" | "jerk" | "limit" | "deviation";

/** Piece i goes from point i to point i + 1 of `xyz`, if `joined[i]`. */
export interface Pieces {
    count: number;
    xyz: Float32Array; // count + 1 points
    time: Float64Array; // of the points
    knot: Uint32Array; // the point of the report where the piece ends
    drawn: Uint8Array; // it has a length and is no standstill
}

export function divide(motion: Motion): Pieces {
    const { path, strips } = motion.report;
    const times: number[] = [];
    const knots: number[] = [];
    for (let k = 0; k < path.count; ++k) {
        if (k > 0 && path.kind[k] !== Kind.standing) {
            const first = Math.floor(path.time[k - 1] / strips.bin) + 1;
            const last = Math.ceil(path.time[k] / strips.bin) - 1;
            for (let bin = first; bin <= last; ++bin) {
                const t = bin * strips.bin;
                if (t > path.time[k - 1] + 1e-9 && t < path.time[k] - 1e-9) {
                    times.push(t);
                    knots.push(k);
                }
            }
        }
        times.push(path.time[k]);
        knots.push(k);
    }
    const count = Math.max(times.length - 1, 0);
    const xyz = new Float32Array(3 * times.length);
    const drawn = new Uint8Array(count);
    const axes = motion.space.map((k) => path.position[k]);
    for (let i = 0; i < times.length; ++i) {
        const whole = i + 1 === times.length || knots[i + 1] !== knots[i]; // a point of the report
        const position = whole ? undefined : motion.place(motion.position(times[i]));
        for (let k = 0; k < 3; ++k) xyz[3 * i + k] = position ? position[k] : (axes[k]?.[knots[i]] ?? 0);
        if (i > 0) drawn[i - 1] = path.kind[knots[i]] !== Kind.standing ? 1 : 0;
    }
    return { count, xyz, time: Float64Array.from(times), knot: Uint32Array.from(knots.slice(1)), drawn };
}

const filament_mm2 = (Math.PI / 4) * 1.75 ** 2;

/** Of a print, of each piece: the width of its bead [mm]; 0: nothing is extruded. Undefined: the program tells nothing of it. */
export function beads(motion: Motion, pieces: Pieces): Float32Array | undefined {
    const { lines: { bead }, layers, path } = motion.report;
    if (!bead.length || !layers.length) return undefined;
    const heights = layers.map((layer) => layer.z);
    return Float32Array.from({ length: pieces.count }, (_, i) => {
        const filament = bead[path.line[pieces.knot[i]]] ?? 0;
        const layer = before(heights, pieces.xyz[3 * i + 5] + 1e-3);
        const tall = heights[layer] - (layer > 0 ? heights[layer - 1] : 0);
        return filament > 0 && tall > 0 ? Math.min((filament * filament_mm2) / tall, 20 * tall) : 0;
    });
}

/** How far the path is from the program on the way to a point: of each row the most. */
function deviation(motion: Motion, knot: number): number {
    const { path, deviation: { rows, mm } } = motion.report;
    const last = path.row[knot];
    let most = 0;
    for (let row = Math.min((path.row[knot - 1] ?? last) + 1, last); row <= last; row += rows) most = Math.max(most, mm[Math.floor(row / rows)] ?? 0);
    return Math.max(most, mm[Math.floor(last / rows)] ?? 0);
}

/** The value of a quantity on a piece: a code for limits, else in its unit. */
export function value(motion: Motion, pieces: Pieces, quantity: Quantity, i: number): number {
    const { path, strips } = motion.report;
    const [from, to] = [pieces.time[i], pieces.time[i + 1]];
    const knot = pieces.knot[i];
    const coarse = to - from < 0.7 * strips.bin; // the report's own piece knows more than the strips
    const bin = motion.bin((from + to) / 2);
    if (quantity === "deviation") return deviation(motion, knot);
    if (quantity === "limit") return coarse ? path.limit[knot] : strips.limit[bin];
    if (quantity === "speed" || quantity === "feed") {
        if (coarse) return quantity === "speed" ? path.speed[knot] : 100 * path.reached[knot];
        const speed = (strips.low[0][bin] + strips.high[0][bin]) / 2;
        return quantity === "speed" ? speed : strips.feed[bin] > 0 ? (100 * speed) / strips.feed[bin] : 0;
    }
    if (coarse) return 100 * (quantity === "jerk" ? path.jerk[knot] : path.acceleration[knot]);
    const first = quantity === "jerk" ? 3 : 2;
    let most = 0;
    motion.report.machine.axes.forEach((axis, k) => {
        if (quantity === "jerk" && !(axis.jerk > 0)) return;
        const c = first + 3 * k;
        most = Math.max(most, strips.high[c][bin], -strips.low[c][bin]);
    });
    return 100 * most;
}

export const units: Record<Quantity, string> = {
    speed: "mm/s",
    feed: "% of the programmed feed",
    acceleration: "% of the limit",
    jerk: "% of the limit",
    limit: "",
    deviation: "mm from the program, of each move the most",
};

export interface Colouring {
    table: Rgb[];
    of: Uint16Array; // the colour of each piece, in the table
    top: number; // the value of the end of the ramp
}

export function colouring(motion: Motion, pieces: Pieces, quantity: Quantity, dark: boolean): Colouring {
    const { totals, deviation: { mm } } = motion.report;
    let top = 100;
    if (quantity === "speed") top = totals.feed.max_speed_mm_s; // of what is coloured: rapids are not
    if (quantity === "deviation") top = mm.reduce((a, b) => Math.max(a, b), 0);
    if (!(top > 0)) top = 1;
    const steps = quantity === "limit" ? limitCodes : 256;
    const table = Array.from({ length: steps }, (_, n) => (quantity === "limit" ? limitColour(n) : ramp(n / (steps - 1), dark)));
    const factor = quantity === "limit" ? 1 : (steps - 1) / top;
    const of = new Uint16Array(pieces.count);
    for (let i = 0; i < pieces.count; ++i) of[i] = Math.min(Math.round(factor * value(motion, pieces, quantity, i)), steps - 1);
    return { table, of, top };
}
