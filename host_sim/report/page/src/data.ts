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
    const bytes = atob(text);
    let at = 0;
    const next = () => {
        let byte = bytes.charCodeAt(at++);
        let rest = byte & 127;
        for (let factor = 128; byte > 127; factor *= 128) { // may be more than 32 bits
            byte = bytes.charCodeAt(at++);
            rest += (byte & 127) * factor;
        }
        return rest;
    };
    const out = new Float64Array(count);
    let value = 0;
    for (let i = 0; i < count; ) {
        const step = next();
        value += step % 2 ? -(step + 1) / 2 : step / 2;
        const equal = step ? 1 : 1 + next();
        out.fill(value * unit, i, i + equal);
        i += equal;
    }
    return out;
}

export interface Places {
    count: number;
    tolerance: number;
    leftOut: boolean;
    position: Float64Array[];
}
/** Of a piece that ends at a point: what the tool did in all of it, as it was before points were left out. */
export interface Path extends Places {
    time: Float64Array;
    speed: Float64Array; // the mean
    reached: Float64Array; // its share of the programmed feed
    line: Float64Array;
    row: Float64Array;
    kind: Float64Array;
    limit: Float64Array;
    acceleration: Float64Array;
    jerk: Float64Array;
}

function places(json: Json): Places {
    return {
        count: json.count,
        tolerance: json.tolerance,
        leftOut: json.left_out,
        position: json.position.map((text: string) => column(text, json.count, json.unit)),
    };
}

function path(json: Json): Path {
    const n = json.count;
    const line = column(json.line, n, 1);
    return {
        ...places(json),
        time: column(json.time, n, json.time_unit),
        speed: column(json.speed, n, json.speed_unit),
        reached: column(json.reached, n, json.load_unit),
        line,
        row: column(json.row, n, 1).map((more, i) => line[i] + more),
        kind: column(json.kind, n, 1),
        limit: column(json.limit, n, 1),
        acceleration: column(json.acceleration, n, json.load_unit),
        jerk: column(json.jerk, n, json.load_unit),
    };
}

/** Of each bin of time the smallest and the largest value of each channel. */
export interface Strips extends Bins {
    whole: number; // length of all
    length: Float64Array;
    feed: Float64Array;
    limit: Float64Array;
}

/** What a target had buffered and how late it was, in seconds: the smallest and the largest in each bin. */
export interface Bins {
    count: number;
    bin: number;
    low: Float64Array[];
    high: Float64Array[];
}

function bins(json: Json): Bins {
    const n = json.count;
    const low = json.channels.map((c: Json) => column(c.low, n, c.unit));
    const high = json.channels.map((c: Json, i: number) => column(c.width, n, c.unit).map((w, j) => w + low[i][j]));
    return { count: n, bin: json.bin_s, low, high };
}

function strips(json: Json): Strips {
    const n = json.count;
    return {
        ...bins(json),
        whole: json.length_mm,
        length: column(json.length, n, json.length_unit),
        feed: column(json.feed, n, json.feed_unit),
        limit: column(json.limit, n, 1),
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
    bead: Float64Array; // of a print: filament by way; empty: nothing is extruded
}

export interface Layer {
    z: number;
    start: number;
    seconds: number;
}

/** Each layer lasts until the next one begins. */
function layers(json: Json, end: number): Layer[] {
    const start = column(json.start, json.count, json.time_unit);
    return [...column(json.height, json.count, json.unit)].map((z, i) => ({ z, start: start[i], seconds: (start[i + 1] ?? end) - start[i] }));
}

export interface Limit {
    name: string;
}

export interface Report {
    program: string;
    stopped: string;
    machine: { name: string; file: string; axes: AxisLimits[] };
    summary: Json;
    limits: Record<string, Limit>;
    totals: Record<string, { time_s: number; length_mm: number; max_speed_mm_s: number }>;
    stops: Stop[];
    stopCount: number;
    operated: { t: number; what: string; value: number }[];
    events: ProgramEvent[];
    eventCount: number;
    tools: { number: number; time_s: number }[];
    layers: Layer[];
    lines: Lines;
    path: Path;
    programmed: Places;
    waypoints: Float64Array[]; // of each axis
    /** The largest distance from the program, of so many rows together. */
    deviation: { rows: number; mm: Float64Array };
    strips: Strips;
    /** buffered, late; no bins: the run was simulated. */
    target: Bins & { least: number };
}

export function read(text: string): Report {
    const json = JSON.parse(text);
    const lines = json.lines;
    const head = lines.text.split("\n");
    head.pop();
    const motion = path(json.path);
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
        events: json.events,
        eventCount: json.event_count,
        tools: json.tools,
        layers: layers(json.layers, motion.time[motion.count - 1] ?? 0),
        lines: {
            unit: lines.unit,
            text: head,
            fileLines: lines.file_lines,
            picked: lines.picked,
            slowest: lines.slowest,
            start: column(lines.start, lines.count, lines.time_unit),
            seconds: column(lines.seconds, lines.count, lines.time_unit),
            limit: column(lines.limit, lines.count, 1),
            bead: column(lines.bead, lines.bead_count, lines.bead_unit),
        },
        path: motion,
        programmed: places(json.programmed),
        waypoints: json.waypoints.position.map((text: string) => column(text, json.waypoints.count, json.waypoints.unit)),
        deviation: { rows: json.deviation.rows, mm: column(json.deviation.mm, json.deviation.count, json.deviation.unit) },
        strips: strips(json.strips),
        target: { ...bins(json.target), least: json.target.least_s },
    };
}
