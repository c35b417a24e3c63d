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
    /** Of lengths and of speeds along the path. */
    readonly lengthUnit: string;
    readonly speedUnit: string;

    constructor(readonly report: Report) {
        const { path, machine } = report;
        this.end = path.count ? path.time[path.count - 1] : 0;
        const names = machine.axes.map((axis) => axis.name.toLowerCase());
        const linear = machine.axes.map((axis, k) => (axis.unit === "mm" ? k : -1)).filter((k) => k >= 0);
        this.lengthUnit = linear.length || !machine.axes.length ? "mm" : "deg";
        this.speedUnit = `${this.lengthUnit}/s`;
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
        const next = i + 1 < strips.count ? strips.length[i + 1] : strips.whole;
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

    /** The lines at a time, from the first to the last: a piece of the path may be of several that were thinned away. */
    lines(t: number): [number, number] {
        const { path, lines } = this.report;
        if (!path.count) return [0, 0];
        const piece = this.piece(t);
        const last = path.line[piece];
        const first = Math.min((path.line[piece - 1] ?? last) + 1, last);
        for (let line = last; line > first && lines.start[last] >= 0; --line) {
            if (lines.start[line] >= 0 && lines.start[line] <= t + 1e-6) return [line, line];
        }
        return lines.start[last] >= 0 ? [first, first] : [first, last];
    }

    /** Whether the pieces of the path are shorter than the bins of the strips there. */
    private finer(piece: number): boolean {
        const { time } = this.report.path;
        return piece > 0 && time[piece] - time[piece - 1] < this.report.strips.bin;
    }

    /** The code of the limit that binds at a time. */
    limit(t: number): number {
        const { path, strips } = this.report;
        const piece = this.piece(t);
        return (this.finer(piece) ? path.limit[piece] : strips.limit[this.bin(t)]) ?? 0;
    }

    /** The share of the cycle time in which a limit binds, as the summary has it. */
    share(code: number): number {
        const share = this.report.summary.limit_share;
        if (!share) return 0;
        const axis = this.report.machine.axes[code & 7]?.name ?? "";
        return [
            share.none, share.programmed_feed, share.feed - share.programmed_feed - share.override, share.velocity[axis], share.acceleration[axis], share.jerk[axis],
            share.centripetal, share.chord, share.override, share.hold, share.dwell,
        ][code >> 3] ?? 0;
    }

    /** When a line begins; nothing: it has no motion. */
    start(line: number): number | undefined {
        const { lines, path } = this.report;
        if (line < lines.start.length) return lines.start[line] >= 0 ? lines.start[line] : undefined;
        const i = path.line.indexOf(line); // of lines that are not here: as exact as the path
        return i > 0 ? path.time[i - 1] : undefined;
    }

    /** The time of the next change of the line, or of the last one. */
    step(t: number, direction: 1 | -1): number {
        const { path, lines } = this.report;
        const { line, time, count } = path;
        // Where a piece is of several lines, those whose times are known.
        const between = (piece: number) => {
            const found = [time[piece - 1]];
            for (let n = (line[piece - 1] ?? 0) + 1; n < line[piece] && n < lines.start.length; ++n) {
                const start = lines.start[n + 1];
                if (start > time[piece - 1] && start < time[piece]) found.push(start);
            }
            return found;
        };
        if (direction > 0) {
            for (let i = this.piece(t + 1e-6); i < count; ++i) {
                const next = (line[i] === line[i - 1] ? [] : between(i)).find((start) => start > t + 1e-6);
                if (next !== undefined) return next;
            }
            return this.end;
        }
        for (let i = this.piece(t - 1e-6); i > 0; --i) {
            const last = (line[i] === line[i - 1] ? [] : between(i)).reverse().find((start) => start < t - 1e-6);
            if (last !== undefined) return last;
        }
        return 0;
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
