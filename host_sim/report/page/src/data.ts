// SPDX-License-Identifier: MIT
// What run_report.cpp writes, decoded.

export interface AxisLimits {
    name: string;
    unit: string;
    velocity: number;
    acceleration: number;
    braking: number;
    jerk: number;
    travel: [number, number] | null;
}
export interface Stop {
    t: number;
    stood_s: number;
    row: number;
    line: number;
    turn_deg: number;
    why: string;
    position: number[];
}
export interface ProgramEvent {
    t: number;
    line?: number;
    what: string;
    number?: number;
    value?: number;
    text?: string;
}
export interface CostlyLine {
    line: number;
    start_s: number;
    time_s: number;
    limit: number;
}
export interface Help {
    limit: string;
    cycle_time_s: number;
    gain: number;
}
/* eslint-disable @typescript-eslint/no-explicit-any */
export type Json = any;

/** A column of integers, as packed_column() packs it, times its unit. */
function column(text: string, count: number, unit: number): Float64Array {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const out = new Float64Array(count);
    let value = 0;
    let at = 0;
    for (let i = 0; i < count; ++i) {
        let rest = 0;
        let factor = 1;
        for (;;) {
            const byte = bytes[at++];
            rest += (byte & 127) * factor; // may be more than 32 bits
            if (byte < 128) break;
            factor *= 128;
        }
        value += rest % 2 ? -(rest + 1) / 2 : rest / 2;
        out[i] = value * unit;
    }
    return out;
}

export interface Path {
    count: number;
    tolerance: number;
    leftOut: boolean;
    time: Float64Array;
    position: Float64Array[];
    line: Float64Array;
    row: Float64Array;
    kind: Float64Array;
    limit: Float64Array;
    acceleration: Float64Array;
    jerk: Float64Array;
}

function path(json: Json): Path {
    const n = json.count;
    return {
        count: n,
        tolerance: json.tolerance,
        leftOut: json.left_out,
        time: column(json.time, n, json.time_unit),
        position: json.position.map((text: string) => column(text, n, json.unit)),
        line: column(json.line, n, 1),
        row: json.row ? column(json.row, n, 1) : new Float64Array(n),
        kind: column(json.kind, n, 1),
        limit: column(json.limit, n, 1),
        acceleration: column(json.acceleration, n, json.load_unit),
        jerk: column(json.jerk, n, json.load_unit),
    };
}

/** Of each bin of time the smallest and the largest value of each channel. */
export interface Strips {
    count: number;
    bin: number;
    length: Float64Array;
    feed: Float64Array;
    limit: Float64Array;
    low: Float64Array[];
    high: Float64Array[];
}

function strips(json: Json): Strips {
    const n = json.count;
    const low = json.channels.map((c: Json) => column(c.low, n, c.unit));
    const high = json.channels.map((c: Json, i: number) => column(c.width, n, c.unit).map((w, j) => w + low[i][j]));
    return {
        count: n,
        bin: json.bin_s,
        length: column(json.length, n, json.length_unit),
        feed: column(json.feed, n, json.feed_unit),
        limit: column(json.limit, n, 1),
        low,
        high,
    };
}

export interface Lines {
    unit: string;
    text: string[];
    fileLines: number;
    picked: Record<string, string>;
    slowest: CostlyLine[];
    start: Float64Array;
    seconds: Float64Array;
    limit: Float64Array;
}

export interface Report {
    program: string;
    stopped: string;
    machine: { name: string; file: string; axes: AxisLimits[] };
    summary: Json;
    limits: Record<string, string>;
    totals: Record<string, { time_s: number; length_mm: number }>;
    stops: Stop[];
    stopCount: number;
    operated: { t: number; what: string; value: number }[];
    events: ProgramEvent[];
    lines: Lines;
    path: Path;
    programmed: Path;
    waypoints: Float64Array[]; // of each axis
    /** The largest distance from the program, of so many rows together. */
    deviation: { rows: number; mm: Float64Array };
    strips: Strips;
}

export function read(text: string): Report {
    const json = JSON.parse(text);
    const lines = json.lines;
    const head = lines.text.split("\n");
    head.pop();
    return {
        program: json.program,
        stopped: json.stopped,
        machine: json.machine,
        summary: json.summary,
        limits: json.limits,
        totals: json.totals,
        stops: json.stops,
        stopCount: json.stop_count,
        operated: json.operated,
        events: json.summary.program?.first_events ?? [],
        lines: {
            unit: lines.unit,
            text: head,
            fileLines: lines.file_lines,
            picked: lines.picked,
            slowest: lines.slowest,
            start: column(lines.start, lines.count, lines.time_unit),
            seconds: column(lines.seconds, lines.count, lines.time_unit),
            limit: column(lines.limit, lines.count, 1),
        },
        path: path(json.path),
        programmed: path(json.programmed),
        waypoints: json.waypoints.position.map((text: string) => column(text, json.waypoints.count, json.waypoints.unit)),
        deviation: { rows: json.deviation.rows, mm: column(json.deviation.mm, json.deviation.count, json.deviation.unit) },
        strips: strips(json.strips),
    };
}
