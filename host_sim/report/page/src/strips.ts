// SPDX-License-Identifier: MIT
// Curves over time or over the length of the path, one below the other, with one cursor and one range.
import uPlot from "uplot";
import { axisColour, css, limitColour, number } from "./colour";
import { el } from "./dom";
import { before, type Motion } from "./motion";

export type Over = "time" | "length";
interface Strip {
    title: string;
    unit: string;
    channel: (axis: number) => number;
    share: boolean;
}

export class Strips {
    readonly element = el("div", { class: "strips" });
    onPick: (t: number) => void = () => {};
    onHover: (t: number) => void = () => {};
    private plots: uPlot[] = [];
    private over: Over = "time";
    private xs = new Float64Array();
    private times = new Float64Array();
    private cursor = 0;
    private range: [number, number] = [0, 1];
    private hidden = new Set<number>();

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

    moveTo(t: number): void {
        this.cursor = t;
        this.plots.forEach((plot) => this.drawCursor(plot));
    }

    whole(): void {
        this.zoom(0, this.xs[this.xs.length - 1] || 1);
    }

    shows(axis: number): boolean {
        return !this.hidden.has(axis);
    }

    /** Axes that never move are not drawn unless they are asked for. */
    showAxis(axis: number, visible: boolean): void {
        if (visible) this.hidden.delete(axis);
        else this.hidden.add(axis);
        this.plots.slice(1).forEach((plot) => plot.setSeries(axis + 1, { show: visible }));
    }

    private dark = false;
    private dragging?: { x: number; from: [number, number]; plot: uPlot };

    private x(t: number): number {
        return this.over === "time" ? t : this.motion.length(t);
    }

    private build(): void {
        const { report } = this.motion;
        const { strips, machine } = report;
        const n = strips.count;
        this.times = new Float64Array(2 * n);
        for (let i = 0; i < n; ++i) {
            const end = Math.min((i + 1) * strips.bin, this.motion.end);
            this.times[2 * i] = i * strips.bin + 0.25 * (end - i * strips.bin);
            this.times[2 * i + 1] = i * strips.bin + 0.75 * (end - i * strips.bin);
        }
        this.xs = this.times.map((t) => this.x(t));
        this.range = [0, this.over === "time" ? this.motion.end : report.summary.length_mm];
        const jerky = machine.axes.some((axis) => axis.jerk > 0);
        const rows: Strip[] = [
            { title: "velocity", unit: "% of limit", channel: (k) => 1 + 3 * k, share: true },
            { title: "acceleration", unit: "% of limit", channel: (k) => 2 + 3 * k, share: true },
            ...(jerky ? [{ title: "jerk", unit: "% of limit", channel: (k: number) => 3 + 3 * k, share: true }] : []),
        ];
        for (const plot of this.plots) plot.destroy();
        this.plots = [];
        this.element.replaceChildren();
        if (!n) {
            this.element.append(el("p", { class: "note" }, "There is no motion."));
            return;
        }
        const plots = [this.speed(), ...rows.map((row) => this.shares(row)), ...(report.target.count ? [this.buffers()] : [])];
        plots.forEach((options, i) => this.frame(options.options, i === plots.length - 1));
        this.plots = plots.map(({ options, data }) => {
            const holder = el("div", { class: "strip" }, el("span", { class: "caption" }, options.title!));
            this.element.append(holder);
            const plot = new uPlot({ ...options, title: undefined }, data, holder);
            this.steer(plot);
            plot.over.append(el("i", { class: "now-line" }));
            return plot;
        });
        this.resize();
    }

    /** The two values of each bin, in the order in which the curve goes on. */
    private curve(channel: number, factor: number): Float64Array {
        const { low, high } = this.motion.report.strips;
        const n = this.motion.report.strips.count;
        const out = new Float64Array(2 * n);
        for (let i = 0; i < n; ++i) {
            const rises = (i + 1 < n ? low[channel][i + 1] + high[channel][i + 1] : 0) >= (i > 0 ? low[channel][i - 1] + high[channel][i - 1] : 0);
            out[2 * i] = factor * (rises ? low : high)[channel][i];
            out[2 * i + 1] = factor * (rises ? high : low)[channel][i];
        }
        return out;
    }

    private speed(): { options: uPlot.Options; data: uPlot.AlignedData } {
        const { strips, summary } = this.motion.report;
        const feed = Float64Array.from({ length: 2 * strips.count }, (_, i) => strips.feed[i >> 1]);
        const top = Math.max(summary.max_speed_mm_s, feed.reduce((a, b) => Math.max(a, Math.min(b, 1.6 * summary.max_speed_mm_s)), 0));
        const ink = this.dark ? "#e8eaed" : "#202124";
        return {
            options: {
                title: "speed [mm/s]; dashed: programmed feed",
                width: 100,
                height: 60,
                series: [
                    {},
                    { stroke: ink, width: 1.5, points: { show: false } },
                    { stroke: ink, width: 1, dash: [5, 4], points: { show: false }, paths: uPlot.paths.stepped!({ align: 1 }) },
                ],
                scales: { y: { range: [0, 1.12 * (top || 1)] } },
                hooks: { draw: [(plot) => this.drawBand(plot)] },
            },
            data: [this.xs, this.curve(0, 1), feed],
        };
    }

    /** What a target has buffered, and how late it is, over the time of the motion. */
    private buffers(): { options: uPlot.Options; data: uPlot.AlignedData } {
        const { count, bin, low, high } = this.motion.report.target;
        const xs = Float64Array.from({ length: 2 * count }, (_, i) => this.x(Math.min((Math.floor(i / 2) + (i % 2 ? 0.75 : 0.25)) * bin, this.motion.end)));
        const curve = (c: number) => xs.map((_, i) => 1000 * (i % 2 ? high : low)[c][i >> 1]);
        const data = [curve(0), curve(1)];
        const most = data.reduce((a, values) => values.reduce((b, v) => Math.max(b, v), a), 1);
        return {
            options: {
                title: "motion in the target's buffers [ms]; dashed: how late it is [ms]",
                width: 100,
                height: 60,
                series: [{}, { stroke: "#009e73", width: 1.3, points: { show: false } }, { stroke: this.dark ? "#ff9955" : "#d55e00", width: 1.5, dash: [5, 3], points: { show: false } }],
                scales: { y: { range: [0, 1.12 * most] } },
            },
            data: [xs, ...data],
        };
    }

    private shares(strip: Strip): { options: uPlot.Options; data: uPlot.AlignedData } {
        const { axes } = this.motion.report.machine;
        const data = axes.map((axis, k) => (strip.title === "jerk" && !(axis.jerk > 0) ? new Float64Array(this.xs.length) : this.curve(strip.channel(k), 100)));
        const most = data.reduce((a, values) => values.reduce((b, v) => Math.max(b, Math.abs(v)), a), 100);
        const reach = most > 100.5 ? Math.min(1.1 * most, 1000) : 118;
        return {
            options: {
                title: `${strip.title} [${strip.unit}]`,
                width: 100,
                height: 60,
                series: [{}, ...axes.map((axis, k) => ({ stroke: axisColour(axis.name, k), width: 1.3, points: { show: false }, show: !this.hidden.has(k) }))],
                scales: { y: { range: [-reach, reach] } },
                axes: [{}, { splits: () => [-100, 0, 100] }],
                hooks: { drawAxes: [(plot) => this.drawLimits(plot)] },
            },
            data: [this.xs, ...data],
        };
    }

    private frame(options: uPlot.Options, last: boolean): void {
        const ink = this.dark ? "#bdc1c6" : "#5f6368";
        const grid = { stroke: this.dark ? "#262b31" : "#eceef0", width: 1 };
        const own = options.axes ?? [];
        const font = "11px system-ui, sans-serif";
        options.axes = [
            { stroke: ink, grid, ticks: { ...grid, size: 4 }, font, size: last ? 32 : 0, values: last ? undefined : () => [], label: last ? (this.over === "time" ? "time [s]" : "length of the path [mm]") : undefined, labelSize: 14, labelGap: -2, labelFont: font, gap: 3 },
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
            const code = px < left + width ? limit[before(this.xs, value) >> 1] : -2;
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
        return this.times[before(this.xs, x)] ?? 0;
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
        const end = this.over === "time" ? this.motion.end : this.motion.report.summary.length_mm;
        const span = Math.min(Math.max(b - a, 1e-5 * end), end);
        const from = Math.min(Math.max(a, 0), end - span);
        this.range = [from, from + span];
        this.element.dataset.range = this.range.join(" ");
        for (const plot of this.plots) plot.setScale("x", { min: from, max: from + span });
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

/** "12.3", or "10 to 12" where a bin holds more. */
export function span(low: number, high: number, digits = 4): string {
    const wide = Math.abs(high - low) > 0.02 * Math.max(Math.abs(low), Math.abs(high));
    return wide ? `${number(low, 3)} to ${number(high, 3)}` : number((low + high) / 2, digits);
}
