// SPDX-License-Identifier: MIT
// The tables beside the pictures.
import { axisColour, css, duration, limitColour, number } from "./colour";
import type { Json, Layer } from "./data";
import { el, table } from "./dom";
import type { Motion } from "./motion";
import { span, type Strips } from "./strips";

type Go = (t: number) => void;
const most_rows = 500; // of a table
type Row = { cells: (string | Node)[]; go?: () => void; id?: string };

export function percent(share: number, digits = 1): string {
    return `${(100 * share).toFixed(digits)}\u00a0%`;
}

function meter(share: number, colour: string, text: string): HTMLElement {
    const fill = el("i");
    fill.style.width = `${Math.min(100 * share, 100)}%`;
    fill.style.background = colour;
    return el("span", { class: "meter" }, fill, el("em", {}, text));
}

function bar(share: number, colour: string, whole = 1): HTMLElement {
    return meter(share / whole, colour, percent(share));
}

export function chip(code: number, name: string): HTMLElement {
    const dot = el("i", { class: "chip" });
    dot.style.background = css(limitColour(code));
    return el("span", {}, dot, name);
}

/** What holds at the cursor: of each axis position, velocity, acceleration and jerk. */
export class Readout {
    readonly element = el("div", { class: "readout" });
    private readonly cells: HTMLElement[][];
    private readonly head = el("div", { class: "now" });
    private readonly modal = el("div", { class: "modal" });

    constructor(
        private readonly motion: Motion,
        private readonly strips: Strips,
    ) {
        const { axes } = motion.report.machine;
        const rows: Row[] = axes.map((axis, k) => {
            const box = el("input", { type: "checkbox", title: "show in the strips" });
            box.checked = strips.shows(k);
            box.addEventListener("change", () => strips.showAxis(k, box.checked));
            const name = el("label", { class: "axis-name" }, box, el("b", {}, axis.name));
            name.style.color = axisColour(axis.name, k);
            return { cells: [name, "", "", "", ""] };
        });
        const units = (per: string) => `[${[...new Set(axes.map((axis) => axis.unit + per))].join(", ")}]`;
        const made = table(["", `position ${units("")}`, `velocity ${units("/s")}`, `acceleration ${units("/s\u00b2")}`, `jerk ${units("/s\u00b3")}`], rows);
        this.cells = [...made.querySelectorAll("tbody tr")].map((row) => [...row.children] as HTMLElement[]);
        this.element.append(this.head, made, this.modal);
    }

    moveTo(t: number): void {
        if (!this.motion.report.path.count) return;
        const { report } = this.motion;
        const position = this.motion.position(t);
        report.machine.axes.forEach((axis, k) => {
            const share = (channel: number, limit: number) => {
                const [low, high] = this.strips.value(channel + 3 * k, t);
                if (!(limit > 0)) return number((low + high) / 2, 3); // of jerk alone
                const value = Math.abs(high) > Math.abs(low) ? high : low;
                return `${number(value * limit, 3)} (${Math.round(100 * value)} %)`;
            };
            const [, low, high] = [0, ...this.strips.value(2 + 3 * k, t)];
            const v = this.strips.value(1 + 3 * k, t);
            const brakes = (low + high) * (v[0] + v[1]) < 0;
            const texts = [
                position[k].toFixed(4),
                share(1, axis.velocity),
                share(2, brakes ? axis.braking : axis.acceleration),
                share(3, axis.jerk),
            ];
            texts.forEach((text, i) => (this.cells[k][i + 1].textContent = text));
        });
        const [first, last] = this.motion.lines(t);
        const [low, high] = this.strips.value(0, t);
        const code = this.motion.limit(t);
        const fact = (name: string, value: string | Node) => el("span", {}, el("small", {}, name), value);
        this.head.replaceChildren(
            fact("time", `${t.toFixed(3)} s`),
            fact(report.lines.unit, last > first ? `${first} to ${last}` : last > 0 ? String(last) : "-"),
            fact("speed", `${span(low, high)} ${this.motion.speedUnit}`),
            fact("limit that binds", chip(code, report.limits[code]?.name ?? "-")),
        );
        this.modal.replaceChildren(...this.motion.modal(t).map((text) => el("span", {}, text)));
    }
}

function facts(rows: [string, string][]): HTMLElement {
    return el("dl", { class: "facts" }, ...rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
}

export function summary(motion: Motion): HTMLElement {
    const { report } = motion;
    const s = report.summary;
    const rows: [string, string][] = [
        ["cycle time", `${number(s.cycle_time_s, 6)} s`],
        ["optimum", s.optimum_time_s ? `${number(s.optimum_time_s, 6)} s (this run takes ${((s.cycle_time_s / s.optimum_time_s - 1) * 100).toFixed(2)} % longer)` : "not known"],
        ["path length", `${number(s.length_mm, 6)} ${motion.lengthUnit}`],
        ["largest speed", `${number(s.max_speed_mm_s, 6)} ${motion.speedUnit}`],
        ["stops on the way", String(s.stops)],
        ...(s.program?.dwells ? [["dwells", `${s.program.dwells}, ${number(s.program.dwell_s, 4)} s`] as [string, string]] : []),
    ];
    const names: Record<string, string> = { feed: "feeds", rapid: "rapids", approach: "to the start", standing: "standing" };
    for (const [kind, name] of Object.entries(names)) {
        const total = report.totals[kind];
        if (total.time_s > 0) rows.push([name, `${duration(total.time_s)}${kind === "standing" ? "" : `, ${number(total.length_mm, 5)} ${motion.lengthUnit}`}`]);
    }
    if (s.waypoint_error_mm !== null) rows.push(["waypoint error", `${number(s.waypoint_error_mm, 3)} mm at most`]);
    rows.push(["smoothing error", `${number(s.smoothing_bound_mm, 3)} mm at most`]);
    rows.push([s.curve === "gcode" ? "moves" : "waypoints", String(s.waypoints)]);
    rows.push(["curve", `${s.curve}, ${s.curve_segments} segments`]);
    rows.push(["machine", report.machine.name]);
    const parts = [facts(rows)];
    if (s.tolerance) {
        const of = s.tolerance;
        const place = (p: Json) => (p.at ? `, ${p.line ? `line ${p.line}` : `at ${p.at}`}` : "");
        const more: [string, string][] = [["deviation", `${number(of.deviation_mm.distance, 3)} mm at most${place(of.deviation_mm)}`]];
        if (of.deviation_deg) more.push(["rotary deviation", `${number(of.deviation_deg.distance, 3)} deg at most${place(of.deviation_deg)}`]);
        more.push(["joints", `${of.blended} rounded, ${of.stopped} with a stop (the end is one), ${of.through} straight on`]);
        more.push(["chains", String(of.chains)]);
        more.push(["with exact stops", `${number(of.exact_stop_time_s, 5)} s (estimated)`]);
        parts.push(el("h3", {}, "Within the tolerance"), facts(more));
    }
    if (s.gpio) parts.push(el("h3", {}, "Lines"), facts(flat(s.gpio)));
    const { path, programmed, strips } = report;
    parts.push(el("h3", {}, "Of this page"), facts([
        ["path", `${path.count} points; none that was left out is farther than ${number(path.tolerance, 2)} mm${path.leftOut ? "; stops were too many to keep all" : ""}`],
        ["strips", `extremes of each ${number(1000 * strips.bin, 3)} ms are kept`],
        ...(programmed.count > 1 ? [["program's path", `${programmed.count} points, within ${number(programmed.tolerance, 2)} mm`] as [string, string]] : []),
        ...(report.stops.length < report.stopCount ? [["stops", `${report.stops.length} of ${report.stopCount} are listed`] as [string, string]] : []),
    ]));
    return el("div", {}, ...parts);
}

/** Of a run on drives: their links, and how much motion they had and how late they were. */
export function drives(motion: Motion): HTMLElement {
    const { link } = motion.report.summary;
    const { least, high } = motion.report.target;
    const rows: [string, string][] = [
        ["least buffered", least >= 0 ? `${number(1000 * least, 3)} ms of motion, before the last of it had come` : "-"],
        ["latest", `${number(1000 * high[1].reduce((a, b) => Math.max(a, b), 0), 3)} ms`],
        ["stopped together", `${link.resumes} time${link.resumes === 1 ? "" : "s"}, on the path`],
        ["clocks known to", `${number(1e6 * link.clocks_known_to_s, 3)} \u00b5s from each other`],
        ["time of the buses' threads", `${number(link.bus_time_s, 3)} s`],
        ...(link.target_period_s ? [
            ["time between targets", `${number(1000 * link.target_period_s, 3)} ms`],
            ["path error between them", `${number(link.between_targets_mm, 3)} mm at most`],
            ["latest target", `${number(1000 * link.latest_target_s, 3)} ms`],
        ] as [string, string][] : []),
    ];
    const keys = Object.keys(link.drives[0] ?? {}).filter((key) => key !== "address");
    const losses = keys.filter((key) => key !== "exchanges" && key !== "segments" && key !== "targets" && link.drives.some((drive: Json) => drive[key] > 0));
    const shown = keys.filter((key) => losses.includes(key) || key === "exchanges" || key === "segments" || key === "targets");
    return el("div", {},
        el("h3", {}, "The drives and their links"), facts(rows),
        table(["", ...link.drives.map((_: Json, i: number) => `drive ${i + 1}`)], shown.map((key) => ({ cells: [key, ...link.drives.map((drive: Json) => String(drive[key]))] }))),
        ...(losses.length ? [] : [el("p", { class: "note" }, "Nothing was lost on a link.")]),
        facts(link.drives.map((drive: Json, i: number) => [`drive ${i + 1}`, drive.address] as [string, string])),
    );
}

function flat(object: Json, prefix = ""): [string, string][] {
    return Object.entries(object).flatMap(([key, value]): [string, string][] => {
        const name = `${prefix}${key.replaceAll("_", " ")}`;
        if (Array.isArray(value)) return value.length > 12 ? [] : value.flatMap((item, i) => (typeof item === "object" ? flat(item, `${name} ${i + 1} `) : [[`${name} ${i + 1}`, String(item)] as [string, string]]));
        if (value !== null && typeof value === "object") return flat(value, `${name} `);
        return [[name, typeof value === "number" ? number(value, 5) : String(value)]];
    });
}

export function limits(motion: Motion): HTMLElement {
    const { report } = motion;
    const share = report.summary.limit_share;
    const parts: (Node | string)[] = [];
    if (share) {
        const code = (kind: number, axis = 0) => css(limitColour(kind * 8 + axis));
        const rows: Row[] = report.machine.axes.map((axis, k) => ({
            cells: [
                `axis ${axis.name}`,
                bar(share.velocity[axis.name], code(3, k)),
                bar(share.acceleration[axis.name], code(4, k)),
                axis.name in share.jerk ? bar(share.jerk[axis.name], code(5, k)) : "no limit",
            ],
        }));
        parts.push(el("h3", {}, "Share of the time at a limit"), table(["", "velocity", "acceleration", "jerk"], rows));
        const kinds: [number, string][] = [[1, "programmed feed"], [2, "machine's feed"], [8, "override"], [9, "hold"], [10, "dwell"], [6, "centripetal"], [7, "chord error"], [0, "no limit"]];
        parts.push(table(["", ""], kinds.map(([kind, name]) => ({ kind, name, value: motion.share(kind * 8) })).filter(({ kind, value }) => value > 0 || kind === 0).map(({ kind, name, value }) => ({ cells: [name, bar(value, code(kind))] }))));
    }
    const use = report.summary.limit_use;
    parts.push(el("h3", {}, "Limits used at most"), table(["", "velocity", "acceleration", "jerk"], report.machine.axes.map(({ name }) => ({
        cells: [`axis ${name}`, percent(use.velocity[name], 2), percent(use.acceleration[name], 2), name in use.jerk ? percent(use.jerk[name], 2) : "no limit"],
    }))));
    const help = report.summary.what_would_help;
    parts.push(el("h3", {}, "What would help"));
    const worth = (help ?? []).filter((item: Json) => item.gain >= 0.0005);
    if (worth.length) {
        parts.push(el("p", { class: "note" }, "Each limit 10 % higher, one at a time, and planned again."));
        parts.push(table(["limit", "cycle time", "less"], worth.map((item: Json) => ({
            cells: [item.limit, `${number(item.cycle_time_s, 5)} s`, bar(item.gain, "#2a788e", worth[0].gain)],
        }))));
    } else {
        parts.push(el("p", { class: "note" }, help ? "No limit alone: 10 % more of one saves less than 0.05 %." : "It was not planned again for this run."));
    }
    return el("div", {}, ...parts);
}

export function costly(motion: Motion, go: Go): HTMLElement {
    const { lines, limits, summary: of } = motion.report;
    if (!lines.slowest.length) return el("p", { class: "note" }, "The input has no lines.");
    const rows = lines.slowest.map((line) => ({
        cells: [
            String(line.line),
            `${number(line.time_s, 4)} s`,
            percent(line.time_s / (of.cycle_time_s || 1)),
            chip(line.limit, limits[line.limit]?.name ?? "-"),
            el("code", {}, (lines.text[line.line - 1] ?? lines.picked[line.line] ?? "").trim().slice(0, 60)),
        ],
        go: () => go(motion.start(line.line) ?? line.start_s),
        id: `line-${line.line}`,
    }));
    return el("div", {}, el("h3", {}, `${lines.unit === "line" ? "Lines" : "Segments"} that take most time`), table([lines.unit, "time", "share", "bound longest by", "text"], rows));
}

export function why(motion: Motion, stop: Motion["report"]["stops"][number]): string {
    const same = motion.report.events.filter((event) => event.t >= stop.t - 1e-6 && event.t <= stop.t + stop.stood_s + 1e-6);
    const event = same.find((e) => /^change|stop$|^input|^spindle_c|^end$/.test(e.what));
    switch (stop.why) {
        case "turn": return stop.turn_deg > 179 ? "it turns back" : `corner of ${number(stop.turn_deg, 3)}\u00b0`;
        case "exact stop": return "exact stop (G61.1)";
        case "program": return event ? event.what.replaceAll("_", " ") : `dwell of ${number(stop.stood_s, 3)} s`;
        default: return event ? event.what.replaceAll("_", " ") : "the program asks for it";
    }
}

/** Those of the program; a hold is the operator's, and an event. */
export function stops(motion: Motion, go: Go): HTMLElement {
    const { stops: all, lines, machine, summary: { stops: count } } = motion.report;
    const shown = all.filter((stop) => stop.why !== "held" && stop.why !== "end").slice(0, most_rows);
    const rows = shown.map((stop) => ({
        cells: [
            `${stop.t.toFixed(3)} s`,
            stop.line > 0 ? `${lines.unit} ${stop.line}` : `point ${stop.row + 1}`,
            why(motion, stop),
            stop.stood_s > 0.0015 ? `${number(stop.stood_s, 3)} s` : "",
            stop.position.slice(0, machine.axes.length).map((p) => Number(p.toFixed(2))).join(", "),
        ],
        go: () => go(stop.t),
    }));
    const title = `${count} stop${count === 1 ? "" : "s"} on the way${shown.length < count ? `, the first ${shown.length}` : ""}`;
    const places = machine.axes.map((axis, k) => (axis.unit === machine.axes[k + 1]?.unit ? axis.name : `${axis.name} [${axis.unit}]`)).join(", ");
    return el("div", {}, el("h3", {}, title), table(["time", "where", "why", "stands", places], rows));
}

export function events(motion: Motion, go: Go): HTMLElement {
    const { events: all, eventCount, operated } = motion.report;
    const shown = all.slice(0, most_rows);
    const rows = [
        ...shown.map((e) => ({ t: e.t, cells: [`${e.t.toFixed(3)} s`, e.line ? `line ${e.line}` : "", e.what.replaceAll("_", " "), [e.number, e.value ? number(e.value, 5) : "", e.text].filter(Boolean).join(" ")] })),
        ...operated.map((o) => ({ t: o.t, cells: [`${o.t.toFixed(3)} s`, "operator", o.what, o.what === "override" ? `${Math.round(100 * o.value)} %` : ""] })),
    ].sort((a, b) => a.t - b.t);
    const more = eventCount > shown.length ? el("p", { class: "note" }, `The first ${shown.length} of ${eventCount} events of the program.`) : "";
    return el("div", {}, el("h3", {}, "Events"), table(["time", "", "what", ""], rows.map((row) => ({ cells: row.cells, go: () => go(row.t) }))), more);
}

/** Time by tool, where there is more than one. */
export function tools(motion: Motion): HTMLElement | "" {
    const { tools: all } = motion.report;
    if (all.length < 2 && !all[0]?.number) return "";
    const rows = all.map(({ number, time_s }) => ({ cells: [number > 0 ? `tool ${number}` : "no tool", duration(time_s), percent(time_s / (motion.end || 1))] }));
    return el("div", {}, el("h3", {}, "Time by tool"), table(["", "time", ""], rows));
}

export function layerTable(all: Layer[], go: Go): HTMLElement {
    const longest = all.reduce((a, layer) => Math.max(a, layer.seconds), 1e-9);
    const rows = all.slice(0, 10000).map((layer, i) => ({
        cells: [String(i + 1), String(Number(layer.z.toFixed(4))), meter(layer.seconds / longest, "#2a788e", duration(layer.seconds))],
        go: () => go(layer.start),
    }));
    const title = `${all.length} layers${rows.length < all.length ? `, the first ${rows.length}` : ""}`;
    return el("div", {}, el("h3", {}, title), table(["layer", "z [mm]", "time"], rows));
}
