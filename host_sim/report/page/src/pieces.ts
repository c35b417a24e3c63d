// SPDX-License-Identifier: MIT
// The path in pieces of one colour each: those of the report, divided where the strips know more.
import { limitColour, ramp, type Rgb } from "./colour";
import { Kind, type Motion } from "./motion";

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
    times.forEach((t, i) => {
        const whole = i + 1 === times.length || knots[i + 1] !== knots[i]; // a point of the report
        const position = whole ? path.position.map((axis) => axis[knots[i]]) : motion.position(t);
        xyz.set(motion.place(position), 3 * i);
        if (i > 0) drawn[i - 1] = path.kind[knots[i]] !== Kind.standing ? 1 : 0;
    });
    return { count, xyz, time: Float64Array.from(times), knot: Uint32Array.from(knots.slice(1)), drawn };
}

/** The value of a quantity on a piece: a code for limits, else in its unit. */
export function value(motion: Motion, pieces: Pieces, quantity: Quantity, i: number): number {
    const { path, strips } = motion.report;
    const [from, to] = [pieces.time[i], pieces.time[i + 1]];
    const knot = pieces.knot[i];
    const coarse = to - from < 0.7 * strips.bin; // the report's own piece knows more than the strips
    const bin = motion.bin((from + to) / 2);
    const { rows, mm } = motion.report.deviation;
    if (quantity === "deviation") return mm[Math.floor(path.row[knot] / rows)] ?? 0;
    if (quantity === "limit") return coarse ? path.limit[knot] : strips.limit[bin];
    if (quantity === "speed" || quantity === "feed") {
        let speed = (strips.low[0][bin] + strips.high[0][bin]) / 2;
        if (coarse && to > from) {
            const way = Math.hypot(...[0, 1, 2].map((k) => pieces.xyz[3 * i + 3 + k] - pieces.xyz[3 * i + k]));
            speed = way > 0 ? way / (to - from) : speed;
        }
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
    colours: Float32Array; // one colour a piece
    top: number; // the value of the end of the ramp
    share: Map<number, number>; // of limits: their part of the time
}

export function colouring(motion: Motion, pieces: Pieces, quantity: Quantity, dark: boolean): Colouring {
    const values = Float32Array.from({ length: pieces.count }, (_, i) => value(motion, pieces, quantity, i));
    let top = 100;
    if (quantity === "speed" || quantity === "deviation") { // of what is coloured: rapids are not
        const { kind } = motion.report.path;
        top = values.reduce((a, b, i) => (pieces.drawn[i] && kind[pieces.knot[i]] === Kind.feed ? Math.max(a, b) : a), 0);
    }
    if (!(top > 0)) top = 1;
    const colours = new Float32Array(3 * pieces.count);
    const share = new Map<number, number>();
    values.forEach((v, i) => {
        const colour: Rgb = quantity === "limit" ? limitColour(v) : ramp(v / top, dark);
        colours.set(colour, 3 * i);
        if (quantity === "limit" && pieces.drawn[i]) {
            share.set(v, (share.get(v) ?? 0) + pieces.time[i + 1] - pieces.time[i]);
        }
    });
    return { colours, top, share };
}
