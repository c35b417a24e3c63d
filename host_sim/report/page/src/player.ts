// SPDX-License-Identifier: MIT
// Play, pause, a bar to scrub, and the rate.
import { duration } from "./colour";
import { el } from "./dom";
import type { Motion } from "./motion";

const rates = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];
const fine = 10000; // steps of the bar

export class Player {
    readonly element: HTMLElement;
    onMove: (t: number) => void = () => {};
    private t = 0;
    private playing = false;
    private last = 0;
    private readonly button = el("button", { class: "play", title: "play or pause (space)", "aria-label": "play" }, "\u25b6");
    private readonly bar = el("input", { type: "range", min: "0", max: String(fine), value: "0", step: "1", "aria-label": "time" });
    private readonly clock = el("output", {});
    private readonly rate = el("select", { title: "speed of playing", "aria-label": "speed of playing" }, ...rates.map((r) => el("option", { value: String(r) }, `\u00d7${r}`)));

    constructor(private readonly motion: Motion) {
        this.rate.value = "1";
        const step = (text: string, title: string, act: () => void) => el("button", { title, "aria-label": title, click: act }, text);
        const unit = motion.report.lines.unit;
        this.element = el("div", { class: "player" },
            step("|\u25c0", `${unit} before (left arrow)`, () => this.step(-1)),
            this.button,
            step("\u25b6|", `next ${unit} (right arrow)`, () => this.step(1)),
            this.bar,
            this.clock,
            this.rate,
        );
        this.button.addEventListener("click", () => this.toggle());
        this.bar.addEventListener("input", () => this.go((Number(this.bar.value) / fine) * motion.end));
    }

    get time(): number {
        return this.t;
    }

    toggle(): void {
        this.playing = !this.playing;
        if (this.playing && this.t >= this.motion.end) this.set(0);
        this.button.textContent = this.playing ? "\u2759\u2759" : "\u25b6";
        this.button.setAttribute("aria-label", this.playing ? "pause" : "play");
        this.last = performance.now();
        if (this.playing) requestAnimationFrame((now) => this.frame(now));
    }

    /** To another time; playing goes on. */
    go(t: number): void {
        this.set(Math.min(Math.max(t, 0), this.motion.end));
    }

    step(direction: 1 | -1): void {
        this.go(this.motion.step(this.t, direction));
    }

    faster(by: 1 | -1): void {
        this.rate.selectedIndex = Math.min(Math.max(this.rate.selectedIndex + by, 0), rates.length - 1);
    }

    private frame(now: number): void {
        if (!this.playing) return;
        const passed = (Math.min(now - this.last, 250) / 1000) * Number(this.rate.value);
        this.last = now;
        this.set(Math.min(this.t + Math.max(passed, 0), this.motion.end));
        if (this.t >= this.motion.end) this.toggle();
        else requestAnimationFrame((next) => this.frame(next));
    }

    private set(t: number): void {
        this.t = t;
        this.bar.value = String(this.motion.end > 0 ? Math.round((t / this.motion.end) * fine) : 0);
        this.clock.textContent = `${duration(t)} of ${duration(this.motion.end)}`;
        this.onMove(t);
    }
}
