// SPDX-License-Identifier: MIT
// Curves over time or over the length of the path, one below the other, with one cursor and one range.
import uPlot from "uplot";
import { axisColour, css, limitColour, number } from "./colour";
import { el } from "./dom";
import { curve, extremes, grouped, sizes, type Group } from "./grouped";
import { before, type Motion } from "./motion";

export type Over = "time" | "length";
/** What a plot shows of a range of bins. */
interface Row {
    options: uPlot.Options;
    data: (bins: Group[]) => { caption: string; values: (number | null)[][] };
    caption?: HTMLElement;
    signed: boolean; // else sizes alone
}
export class Strips {
    readonly element = el("div", { class: "strips" });
    onPick: (t: number) => void = () => {};
    onHover: (t: number) => void = () => {};
    private plots: uPlot[] = [];
    private rows: Row[] = []; // one for each plot
    private over: Over = "time";
    private edges = new Float64Array(); // where bins begin, in time or length, and where the last one ends
    private cursor = 0;
    private range: [number, number] = [0, 1];
    private hidden = new Set<number>();
    private asked = false; // a new range waits to be drawn

    constructor(private readonly motion: Motion) {
        new ResizeObserver(() => this.resize()).observe(this.element);
        const { low, high } = motion.report.strips;
        motion.report.machine.axes.forEach((_, k) => {
            const c = 1 + 3 * k;
            if (low[c].every((v) => v === 0) && high[c].every((v) => v === 0)) this.hidden.add(k);
        });
        addEventListener("pointerup", () => (this.dragging = undefined));
        addEventListener("pointermove", (event) => this.drag(event));
    }

    /** Builds the plots for a ground that is light or dark. */
    dress(dark: boolean): void {
        this.dark = dark;
        this.build();
    }

    set(over: Over): void {
        this.over = over;
        this.build();
    }

    /** A range that is zoomed follows the cursor. */
    moveTo(t: number): void {
        this.cursor = t;
        const [a, b] = this.range;
        const x = this.x(t);
        if (x < a || x > b) this.zoom(...(x > b && x < 2 * b - a ? [x - 0.1 * (b - a), x + 0.9 * (b - a)] : [x - 0.5 * (b - a), x + 0.5 * (b - a)]) as [number, number]);
        this.plots.forEach((plot) => this.drawCursor(plot));
    }

    whole(): void {
        this.zoom(0, this.whole_x || 1);
    }

    shows(axis: number): boolean {
        return !this.hidden.has(axis);
    }

    /** Axes that never move are not drawn unless they are asked for. */
    showAxis(axis: number, visible: boolean): void {
        if (visible) this.hidden.delete(axis);
        else this.hidden.add(axis);
        this.rows.forEach((row, i) => {
            if (row.options.series.length > 3 * axis + 3 && i > 0) for (const n of [1, 2, 3]) this.plots[i].setSeries(3 * axis + n, { show: visible });
        });
        this.refill();
    }

    private dark = false;
    private dragging?: { x: number; from: [number, number]; plot: uPlot };

    private x(t: number): number {
        return this.over === "time" ? t : this.motion.length(t);
    }

    private get whole_x(): number {
        return this.edges[this.edges.length - 1] ?? 0;
    }

    private build(): void {
        const { report } = this.motion;
        const { strips, machine } = report;
        const n = strips.count;
        this.edges = Float64Array.from({ length: n + 1 }, (_, i) => this.x(Math.min(i * strips.bin, this.motion.end)));
        this.range = [0, this.whole_x];
        delete this.element.dataset.range;
        const jerky = machine.axes.some((axis) => axis.jerk > 0);
        for (const plot of this.plots) plot.destroy();
        this.plots = [];
        this.element.replaceChildren();
        if (!n) {
            this.element.append(el("p", { class: "note" }, "There is no motion."));
            return;
        }
        this.rows = [
            this.speed(),
            this.shares("velocity", 1),
            this.shares("acceleration", 2),
            ...(jerky ? [this.shares("jerk", 3)] : []),
            ...(report.target.count ? [this.buffers()] : []),
        ];
        this.rows.forEach((row, i) => this.frame(row.options, i === this.rows.length - 1));
        this.plots = this.rows.map((row) => {
            row.caption = el("span", { class: "caption" });
            const holder = el("div", { class: "strip" }, row.caption);
            this.element.append(holder);
            const plot = new uPlot(row.options, [[]], holder);
            this.steer(plot);
            plot.over.append(el("i", { class: "now-line" }));
            return plot;
        });
        this.resize();
        this.refill();
    }

    private refill(): void {
        if (!this.plots.length) return;
        const bins = grouped(this.edges, this.range);
        const xs = bins.flatMap(({ first, last, whole }) => {
            const [a, b] = [this.edges[first], this.edges[last]];
            return whole ? [(a + b) / 2] : [a + 0.25 * (b - a), a + 0.75 * (b - a)];
        });
        const [min, max] = this.range;
        this.element.dataset.drawn = bins[0]?.whole ? "means" : "bins";
        this.plots.forEach((plot, i) => {
            const { caption, values } = this.rows[i].data(bins);
            this.rows[i].caption!.textContent = caption;
            plot.batch(() => {
                plot.setData([xs, ...values] as uPlot.AlignedData, true);
                plot.setScale("x", { min, max });
            });
        });
    }

    private speed(): Row {
        const { strips, summary } = this.motion.report;
        const top = Math.max(summary.max_speed_mm_s, strips.feed.reduce((a, b) => Math.max(a, Math.min(b, 1.6 * summary.max_speed_mm_s)), 0));
        const ink = this.dark ? "#e8eaed" : "#202124";
        const none = { points: { show: false }, width: 0 };
        const unit = this.motion.speedUnit;
        return {
            options: {
                width: 100,
                height: 60,
                series: [
                    {},
                    { stroke: ink, width: 1.5, points: { show: false } },
                    { stroke: ink, width: 1, dash: [5, 4], points: { show: false }, paths: uPlot.paths.stepped!({ align: 1 }) },
                    none,
                    none,
                ],
                bands: [{ series: [4, 3], fill: faint(ink) }],
                scales: { y: { range: [0, 1.12 * (top || 1)] } },
                hooks: { draw: [(plot) => this.drawBand(plot)] },
            },
            signed: false,
            data: (bins) => ({
                caption: `speed [${unit}]${bins[0]?.whole ? " and its extremes" : ""}; dashed: programmed feed`,
                values: [
                    curve(strips, 0, 1, bins),
                    bins.flatMap(({ first, last, whole }) => (whole ? [strips.feed.subarray(first, last).reduce((a, b) => Math.max(a, b))] : [strips.feed[first], strips.feed[first]])),
                    ...extremes(strips, 0, 1, bins),
                ],
            }),
        };
    }

    /** What a target has buffered, and how late it is, over the time of the motion. */
    private buffers(): Row {
        const { target, strips } = this.motion.report;
        const most = Math.max(1, ...[0, 1].map((c) => 1000 * target.high[c].reduce((a, b) => Math.max(a, b), 0)));
        // Its bins are others: the least that was buffered, and the latest.
        const at = (c: number, { first, last }: Group) => {
            const index = (i: number) => Math.min(Math.floor((i * strips.bin) / target.bin), target.count - 1);
            const part = (c ? target.high : target.low)[c].subarray(index(first), index(last) + 1);
            return 1000 * part.reduce((a, b) => (c ? Math.max(a, b) : Math.min(a, b)));
        };
        return {
            options: {
                width: 100,
                height: 60,
                series: [{}, { stroke: "#009e73", width: 1.3, points: { show: false } }, { stroke: this.dark ? "#ff9955" : "#d55e00", width: 1.5, dash: [5, 3], points: { show: false } }],
                scales: { y: { range: [0, 1.12 * most] } },
            },
            signed: false,
            data: (bins) => ({
                caption: "motion in the target's buffers [ms]; dashed: how late it is [ms]",
                values: [0, 1].map((c) => bins.flatMap((group) => (group.whole ? [at(c, group)] : [at(c, group), at(c, group)]))),
            }),
        };
    }

    private shares(name: "velocity" | "acceleration" | "jerk", first: number): Row {
        const { strips, machine } = this.motion.report;
        const limited = (k: number) => machine.axes[k][name] > 0;
        const channels = machine.axes.map((_, k) => first + 3 * k);
        const most = channels.reduce((a, c, k) => (limited(k) ? strips.high[c].reduce((b, v, i) => Math.max(b, 100 * v, -100 * strips.low[c][i]), a) : a), 100);
        const reach = most > 100.5 ? Math.min(1.1 * most, 1000) : 118;
        const row: Row = {
            options: {
                width: 100,
                height: 60,
                series: [{}, ...machine.axes.flatMap((axis, k) => {
                    const show = !this.hidden.has(k);
                    return [{ stroke: axisColour(axis.name, k), width: 1.3, points: { show: false }, show }, { width: 0, points: { show: false }, show }, { width: 0, points: { show: false }, show }];
                })],
                bands: machine.axes.map((axis, k) => ({ series: [3 * k + 3, 3 * k + 2] as [number, number], fill: faint(axisColour(axis.name, k)) })),
                scales: { y: { range: () => [row.signed ? -reach : 0, reach] } },
                axes: [{}, { splits: () => (row.signed ? [-100, 0, 100] : [0, 50, 100]) }],
                hooks: { drawAxes: [(plot) => this.drawLimits(plot)] },
            },
            signed: true,
            data: (bins) => {
                const whole = bins[0]?.whole ?? false;
                const curves = channels.map((c, k) => (limited(k) ? curve(strips, c, 100, bins) : Array(bins.length * (whole ? 1 : 2)).fill(0)));
                const means = whole ? channels.map((c) => sizes(strips, c, 100, bins)) : [];
                // Where an axis goes to and fro within each group, the mean says nothing: then sizes are shown.
                const total = (all: number[][]) => all.reduce((a, values, k) => (this.hidden.has(k) || !limited(k) ? a : values.reduce((b, v) => b + Math.abs(v), a)), 0);
                row.signed = !whole || total(curves) > 0.6 * total(means);
                const none = Array(bins.length * (whole ? 1 : 2)).fill(null);
                return {
                    caption: `${name} [% of limit]${!whole ? "" : row.signed ? " and its extremes" : ", the mean of its size"}`,
                    values: channels.flatMap((c, k) => (row.signed ? [curves[k], ...(limited(k) ? extremes(strips, c, 100, bins) : [none, none])] : [limited(k) ? means[k] : none, none, none])),
                };
            },
        };
        return row;
    }

    private frame(options: uPlot.Options, last: boolean): void {
        const ink = this.dark ? "#bdc1c6" : "#5f6368";
        const grid = { stroke: this.dark ? "#262b31" : "#eceef0", width: 1 };
        const own = options.axes ?? [];
        const font = "11px system-ui, sans-serif";
        options.axes = [
            { stroke: ink, grid, ticks: { ...grid, size: 4 }, font, size: last ? 32 : 0, values: last ? undefined : () => [], label: last ? (this.over === "time" ? "time [s]" : `length of the path [${this.motion.lengthUnit}]`) : undefined, labelSize: 14, labelGap: -2, labelFont: font, gap: 3 },
            { stroke: ink, grid, ticks: { ...grid, size: 4 }, font, size: 44, gap: 3, ...own[1] },
        ];
        options.legend = { show: false };
        options.padding = [17, 10, last ? 0 : 5, 0];
        options.scales = { ...options.scales, x: { time: false, range: () => this.range } };
        options.cursor = { sync: { key: "strips" }, drag: { x: true, y: false, setScale: false }, y: false, points: { show: false } };
        options.select = { show: true, left: 0, top: 0, width: 0, height: 0 };
        options.hooks = {
            ...options.hooks,
            draw: [...(options.hooks?.draw ?? []), (plot) => this.drawCursor(plot)],
            setSelect: [(plot) => this.select(plot)],
        };
    }

    private drawLimits(plot: uPlot): void {
        const draw = plot.ctx;
        draw.save();
        draw.strokeStyle = this.dark ? "#f2994a" : "#b3541e";
        draw.lineWidth = devicePixelRatio;
        draw.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
        for (const v of [-100, 100]) {
            const y = Math.round(plot.valToPos(v, "y", true)) + 0.5;
            draw.beginPath();
            draw.moveTo(plot.bbox.left, y);
            draw.lineTo(plot.bbox.left + plot.bbox.width, y);
            draw.stroke();
        }
        draw.restore();
    }

    /** Which limit binds, as a band at the foot of the first strip. */
    private drawBand(plot: uPlot): void {
        const { left, top, width, height } = plot.bbox;
        const { limit } = this.motion.report.strips;
        const draw = plot.ctx;
        const tall = 6 * devicePixelRatio;
        let from = left;
        let now = -1;
        for (let px = left; px <= left + width; ++px) {
            const value = plot.posToVal(px, "x", true);
            const code = px < left + width ? limit[Math.min(before(this.edges, value), limit.length - 1)] : -2;
            if (code === now) continue;
            if (now >= 0) {
                draw.fillStyle = css(limitColour(now));
                draw.fillRect(from, top + height - tall, px - from, tall);
            }
            from = px;
            now = code;
        }
    }

    private drawCursor(plot: uPlot): void {
        const line = plot.over.querySelector<HTMLElement>(".now-line");
        if (!line) return;
        const x = plot.valToPos(this.x(this.cursor), "x");
        line.hidden = !(x >= 0 && x <= plot.over.clientWidth);
        line.style.transform = `translateX(${x.toFixed(1)}px)`;
    }

    private timeAt(plot: uPlot, left: number): number {
        const x = plot.posToVal(left, "x");
        if (this.over === "time") return Math.min(Math.max(x, 0), this.motion.end);
        const i = before(this.edges, x);
        const [from, to] = [this.edges[i], this.edges[i + 1] ?? x];
        return Math.min((i + (to > from ? Math.min((x - from) / (to - from), 1) : 0)) * this.motion.report.strips.bin, this.motion.end);
    }

    private steer(plot: uPlot): void {
        plot.over.addEventListener("mousemove", (event) => this.onHover(this.timeAt(plot, event.offsetX)));
        plot.over.addEventListener("mouseleave", () => this.onHover(-1));
        plot.over.addEventListener("click", (event) => this.onPick(this.timeAt(plot, event.offsetX)));
        plot.over.addEventListener("dblclick", () => this.whole());
        plot.over.addEventListener(
            "wheel",
            (event) => {
                event.preventDefault();
                const [a, b] = this.range;
                if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
                    const by = ((event.deltaX || event.deltaY) / plot.over.clientWidth) * (b - a);
                    this.zoom(a + by, b + by);
                    return;
                }
                const at = plot.posToVal(event.offsetX, "x");
                const factor = 1.0015 ** event.deltaY;
                this.zoom(at - (at - a) * factor, at + (b - at) * factor);
            },
            { passive: false },
        );
        plot.over.addEventListener(
            "mousedown",
            (event) => {
                if (event.button !== 1 && !event.shiftKey) return;
                event.preventDefault();
                event.stopImmediatePropagation();
                this.dragging = { x: event.clientX, from: this.range, plot };
            },
            { capture: true },
        );
    }

    private drag(event: PointerEvent): void {
        if (!this.dragging) return;
        const { x, from, plot } = this.dragging;
        const by = ((x - event.clientX) / plot.over.clientWidth) * (from[1] - from[0]);
        this.zoom(from[0] + by, from[1] + by);
    }

    private select(plot: uPlot): void {
        if (plot.select.width < 4) return;
        const [a, b] = [plot.select.left, plot.select.left + plot.select.width].map((left) => plot.posToVal(left, "x"));
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        this.zoom(a, b);
    }

    private zoom(a: number, b: number): void {
        const end = this.whole_x;
        const span = Math.min(Math.max(b - a, 1e-5 * end), end);
        const from = Math.min(Math.max(a, 0), end - span);
        this.range = [from, from + span];
        this.element.dataset.range = this.range.join(" ");
        if (this.asked) return; // of many turns of a wheel the last one
        this.asked = true;
        requestAnimationFrame(() => {
            this.asked = false;
            this.refill();
        });
    }

    resize(): void {
        const { clientWidth: w, clientHeight: h } = this.element;
        if (!w || !h || !this.plots.length) return;
        const foot = 32;
        const each = Math.floor((h - foot) / this.plots.length);
        this.plots.forEach((plot, i) => plot.setSize({ width: w, height: i + 1 === this.plots.length ? h - each * i : each }));
    }

    /** What a strip says at a time, for tests and tables. */
    value(channel: number, t: number): [number, number] {
        const { low, high } = this.motion.report.strips;
        const i = this.motion.bin(t);
        return [low[channel][i], high[channel][i]];
    }
}

/** A colour for what lies behind a curve. */
function faint(colour: string): string {
    return `${colour}2e`;
}

/** "12.3", or "10 to 12" where a bin holds more. */
export function span(low: number, high: number, digits = 4): string {
    const wide = Math.abs(high - low) > 0.02 * Math.max(Math.abs(low), Math.abs(high));
    return wide ? `${number(low, 3)} to ${number(high, 3)}` : number((low + high) / 2, digits);
}
