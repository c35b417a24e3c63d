// SPDX-License-Identifier: MIT
// The program's text beside its times: only the rows that are seen are elements.
import { css, limitColour } from "./colour";
import { el } from "./dom";
import type { Motion } from "./motion";

const height = 19; // [px] of a row
const tallest = 8e6; // [px] of a list that browsers lay out

export class Listing {
    readonly element: HTMLElement;
    onPick: (line: number) => void = () => {};
    private readonly rows = el("div", { class: "rows" });
    private readonly space = el("div", { class: "all" });
    private readonly count: number;
    private readonly longest: number;
    private now = 0;
    private readonly scale: number;

    constructor(private readonly motion: Motion) {
        const { lines } = motion.report;
        this.count = Math.max(lines.text.length, lines.text.length ? 0 : lines.start.length - 1);
        this.longest = lines.seconds.reduce((a, b) => Math.max(a, b), 0) || 1;
        this.scale = Math.min(1, tallest / (height * Math.max(this.count, 1)));
        this.space.style.height = `${this.count * height * this.scale}px`;
        this.space.append(this.rows);
        this.element = el("div", { class: "listing", tabindex: "-1" }, this.space, this.cut());
        this.element.addEventListener("scroll", () => this.draw());
        new ResizeObserver(() => this.draw()).observe(this.element);
    }

    private cut(): HTMLElement {
        const { lines } = this.motion.report;
        if (!this.count) return el("p", { class: "note" }, "The input cannot be read twice, so its text is not here.");
        if (lines.text.length < lines.fileLines) {
            return el("p", { class: "note" }, `The text is cut here: this page holds ${lines.text.length} of ${lines.fileLines} lines. Times, places and the costliest lines are of all.`);
        }
        return el("p", { class: "note" }, "End of the text.");
    }

    mark(line: number): void {
        if (line === this.now) return;
        this.now = line;
        if (line > 0 && line <= this.count) {
            const at = (line - 1) * height * this.scale;
            const { scrollTop, clientHeight } = this.element;
            if (at < scrollTop + height || at > scrollTop + clientHeight - 3 * height) {
                this.element.scrollTop = at - clientHeight / 2.5;
            }
        }
        this.draw();
    }

    draw(): void {
        const { lines } = this.motion.report;
        const { scrollTop, clientHeight } = this.element;
        if (!clientHeight) return;
        const first = Math.max(0, Math.floor(scrollTop / (height * this.scale)) - 4);
        const last = Math.min(this.count, first + Math.ceil(clientHeight / height) + 8);
        this.rows.style.transform = `translateY(${this.scale < 1 ? scrollTop - 4 * height : first * height}px)`;
        const rows: HTMLElement[] = [];
        for (let line = first + 1; line <= last; ++line) {
            const seconds = line < lines.seconds.length ? lines.seconds[line] : 0;
            const bar = el("i", { class: "bar" });
            bar.style.width = `${(100 * seconds) / this.longest}%`;
            if (seconds > 0) bar.style.background = css(limitColour(lines.limit[line]));
            const row = el(
                "div",
                { class: line === this.now ? "row here" : seconds > 0 ? "row" : "row idle" },
                el("b", {}, String(line)),
                el("span", { class: "text" }, lines.text[line - 1] ?? `${lines.unit} ${line}`),
                el("span", { class: "time" }, bar, el("em", {}, seconds > 0 ? seconds.toFixed(3) : "")),
            );
            row.dataset.line = String(line);
            row.addEventListener("click", () => this.onPick(line));
            rows.push(row);
        }
        this.rows.replaceChildren(...rows);
    }
}
