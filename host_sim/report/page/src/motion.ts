// SPDX-License-Identifier: MIT
// Questions to a run: where is the machine at a time, and what does it do there.
import type { Report } from "./data";

export const enum Kind {
    feed,
    rapid,
    approach,
    standing,
}

/** The largest i with values[i] <= value, at least 0; values in order. */
export function before(values: ArrayLike<number>, value: number): number {
    let low = 0;
    let high = values.length;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (values[middle] <= value) low = middle;
        else high = middle;
    }
    return low;
}

export class Motion {
    readonly end: number;
    /** Which axes are drawn as x, y and z; -1: none. */
    readonly space: [number, number, number];

    constructor(readonly report: Report) {
        const { path, machine } = report;
        this.end = path.count ? path.time[path.count - 1] : 0;
        const names = machine.axes.map((axis) => axis.name.toLowerCase());
        const linear = machine.axes.map((axis, k) => (axis.unit === "mm" ? k : -1)).filter((k) => k >= 0);
        const spare = linear.length ? linear : machine.axes.map((_, k) => k);
        const named = ["x", "y", "z"].map((name) => names.indexOf(name));
        const usual = named.some((k) => k >= 0) && linear.length > 0;
        this.space = (usual ? named : [spare[0] ?? -1, spare[1] ?? -1, spare[2] ?? -1]) as [number, number, number];
    }

    bin(t: number): number {
        return Math.min(Math.max(Math.floor(t / this.report.strips.bin), 0), this.report.strips.count - 1);
    }

    /** Travelled along the path. */
    length(t: number): number {
        const { strips } = this.report;
        const i = this.bin(t);
        const next = i + 1 < strips.count ? strips.length[i + 1] : this.report.summary.length_mm;
        const begin = i * strips.bin;
        const end = Math.min(begin + strips.bin, this.end);
        const share = end > begin ? Math.min(Math.max((t - begin) / (end - begin), 0), 1) : 0;
        return strips.length[i] + share * Math.max(next - strips.length[i], 0);
    }

    /** The piece of the path at a time: it ends at point `piece`. */
    piece(t: number): number {
        return Math.min(before(this.report.path.time, t) + 1, this.report.path.count - 1);
    }

    /** The share of the piece that is travelled. */
    private travelled(piece: number, t: number): number {
        const { time, kind } = this.report.path;
        if (piece < 1 || kind[piece] === Kind.standing) return 1;
        const [from, to] = [this.length(time[piece - 1]), this.length(time[piece])];
        if (to > from) return Math.min(Math.max((this.length(t) - from) / (to - from), 0), 1);
        const span = time[piece] - time[piece - 1];
        return span > 0 ? Math.min(Math.max((t - time[piece - 1]) / span, 0), 1) : 1;
    }

    /** Of all axes. */
    position(t: number): number[] {
        const { path } = this.report;
        if (!path.count) return path.position.map(() => 0);
        const piece = this.piece(t);
        const share = this.travelled(piece, t);
        return path.position.map((axis) => {
            const from = axis[Math.max(piece - 1, 0)];
            return from + share * (axis[Math.max(piece, 0)] - from);
        });
    }

    place(position: number[]): [number, number, number] {
        return this.space.map((k) => (k >= 0 ? position[k] : 0)) as [number, number, number];
    }

    line(t: number): number {
        return this.report.path.count ? this.report.path.line[this.piece(t)] : 0;
    }

    /** When a line begins; nothing: it has no motion. */
    start(line: number): number | undefined {
        const { lines, path } = this.report;
        const i = path.line.indexOf(line); // as exact as the path; lines that were thinned away have their own time
        if (i > 0) return path.time[i - 1];
        return line < lines.start.length && lines.start[line] >= 0 ? lines.start[line] : undefined;
    }

    /** The time of the next change of the line, or of the last one. */
    step(t: number, direction: 1 | -1): number {
        const { line, time, count } = this.report.path;
        let i = this.piece(t + 1e-9);
        const now = line[i];
        if (direction > 0) {
            while (i + 1 < count && line[i] === now) ++i;
            return line[i] === now ? this.end : time[i - 1];
        }
        while (i > 1 && line[i - 1] === now) --i; // its first piece
        if (t > time[i - 1] + 1e-9) return time[i - 1];
        const last = line[i - 1];
        for (--i; i > 1 && line[i - 1] === last; ) --i;
        return i >= 1 ? time[i - 1] : 0;
    }

    /** What holds at a time of what the program ordered: tool, spindle, coolant. */
    modal(t: number): string[] {
        let tool = "";
        let spindle = "";
        const coolant = new Set<string>();
        let rpm = 0;
        for (const event of this.report.events) {
            if (event.t > t + 1e-9) break;
            if (event.what === "change_tool" || event.what === "set_tool") tool = `tool ${event.number ?? 0}`;
            if (event.what === "spindle_speed") rpm = event.value ?? 0;
            if (event.what.startsWith("spindle_c")) {
                rpm = event.value ?? rpm;
                spindle = event.what === "spindle_clockwise" ? "spindle clockwise" : "spindle counterclockwise";
            }
            if (event.what === "spindle_stop") spindle = "";
            if (event.what === "mist_on" || event.what === "flood_on") coolant.add(event.what.slice(0, -3));
            if (event.what === "coolant_off") coolant.clear();
        }
        let factor = 1;
        let held = false;
        for (const done of this.report.operated) {
            if (done.t > t + 1e-9) break;
            if (done.what === "override") factor = done.value;
            if (done.what === "hold") held = true;
            if (done.what === "resume") held = false;
        }
        return [
            tool,
            spindle && (rpm ? `${spindle}, ${rpm} 1/min` : spindle),
            ...coolant,
            factor !== 1 ? `override ${Math.round(100 * factor)} %` : "",
            held ? "held" : "",
        ].filter(Boolean);
    }
}
