// SPDX-License-Identifier: MIT
// The page: its parts, and how they follow one cursor.
import { css, duration, number, ramp } from "./colour";
import { read } from "./data";
import { el } from "./dom";
import { Listing } from "./listing";
import { Motion } from "./motion";
import * as panels from "./panels";
import type { Quantity } from "./pieces";
import { units } from "./pieces";
import { Player } from "./player";
import { preparedRenderer } from "./renderer";
import { Space, type View } from "./scene";
import { Strips, type Over } from "./strips";

const renderer = preparedRenderer();
const report = read(document.getElementById("data")!.textContent!);
const motion = new Motion(report);
const space = new Space(motion, renderer);
const strips = new Strips(motion);
const player = new Player(motion);
const listing = new Listing(motion);
const readout = new panels.Readout(motion, strips);

function moveTo(t: number): void {
    space.moveTo(t);
    strips.moveTo(t);
    readout.moveTo(t);
    listing.mark(motion.lines(t)[1]);
}
const go = (t: number) => player.go(t);
player.onMove = moveTo;
space.onPick = go;
strips.onPick = go;
strips.onHover = (t) => space.hover(t);
listing.onPick = (line) => {
    const t = motion.start(line);
    if (t !== undefined) go(t);
};

// Which part a change of the ground, of colours or of tabs concerns.
let dark = matchMedia("(prefers-color-scheme: dark)").matches;
const legend = el("div", { class: "legend" });

function drawLegend(): void {
    const { quantity, coloured } = space;
    if (quantity === "limit") {
        const rows = Object.entries(report.limits).map(([code, { name }]) => ({ code: Number(code), name, share: motion.share(Number(code)) }));
        const shown = rows.filter(({ share }) => share > 0).sort((a, b) => b.share - a.share).slice(0, innerWidth > 900 ? 9 : 5);
        legend.replaceChildren(el("small", {}, "share of the cycle time"), ...shown.map(({ code, name, share }) => el("div", {}, panels.chip(code, name), el("small", {}, ` ${panels.percent(share)}`))));
        return;
    }
    const bar = el("canvas", { width: "120", height: "1" });
    const draw = bar.getContext("2d")!;
    for (let i = 0; i < 120; ++i) {
        draw.fillStyle = css(ramp(i / 119, document.documentElement.dataset.theme === "dark"));
        draw.fillRect(i, 0, 1, 1);
    }
    legend.replaceChildren(el("div", { class: "scale" }, "0", bar, `${number(coloured.top, 4)} ${units[quantity]}`));
}

function dress(night: boolean): void {
    document.documentElement.dataset.theme = night ? "dark" : "light";
    space.dress(night);
    strips.dress(night);
    moveTo(player.time);
    drawLegend();
}

function choice<T extends string>(label: string, options: [T, string][], act: (value: T) => void): HTMLSelectElement {
    const select = el("select", { title: label, "aria-label": label }, ...options.map(([value, text]) => el("option", { value }, text)));
    select.addEventListener("change", () => act(select.value as T));
    return select;
}

const jerky = report.machine.axes.some((axis) => axis.jerk > 0);
const colours = choice<Quantity>("colours of the path", [
    ["speed", "speed"],
    ["limit", "limit that binds"],
    ["acceleration", "acceleration"],
    ...(jerky ? [["jerk", "jerk"] as [Quantity, string]] : []),
    ["feed", "feed reached"],
    ...(report.deviation.mm.length ? [["deviation", "deviation from the program"] as [Quantity, string]] : []),
], (quantity) => {
    space.paint(quantity);
    drawLegend();
});
const view = (name: View, key: string) => el("button", { title: `view: ${name} (${key})`, click: () => space.look(name) }, name);
const toggle = (name: string, text: string, on: boolean) => {
    const box = el("input", on ? { type: "checkbox", checked: "" } : { type: "checkbox" });
    box.addEventListener("change", () => space.show(name, box.checked));
    if (!on) space.show(name, false);
    return el("label", {}, box, text);
};
const boxed = motion.space.every((k) => k < 0 || report.machine.axes[k].travel);
const rising = report.layers;
const tools = el("div", { class: "tools" },
    el("span", {}, "colour ", colours),
    el("span", { class: "views" }, view("free", "1"), view("top", "2"), view("front", "3"), view("side", "4")),
    el("span", { class: "layers-of" },
        ...(report.programmed.count > 1 ? [toggle("programmed", "program", !rising.length)] : []),
        ...(report.totals.rapid.time_s > 0 || report.lines.bead.length ? [toggle("rapids", report.lines.bead.length ? "travel moves" : "rapids", !rising.length)] : []),
        toggle("stops", "stops", true), ...(report.waypoints[0]?.length ? [toggle("points", "waypoints", space.sparse)] : []), toggle("arrows", "direction", true),
        toggle("tool", "tool", !space.flat), toggle("zero", "zero", true), ...(boxed ? [toggle("travel", "travel", false)] : [])),
);

if (rising.length) {
    const last = String(rising.length - 1);
    const low = el("input", { type: "range", min: "0", max: last, value: "0", "aria-label": "lowest layer" });
    const high = el("input", { type: "range", min: "0", max: last, value: last, "aria-label": "highest layer" });
    const said = el("output", {});
    const apply = () => {
        const [a, b] = [Math.min(+low.value, +high.value), Math.max(+low.value, +high.value)];
        const whole = a === 0 && b === rising.length - 1;
        const between = (i: number) => (rising[i - 1].z + rising[i].z) / 2;
        space.layers(a === 0 ? -1e9 : between(a), b + 1 === rising.length ? 1e9 : between(b + 1));
        said.textContent = whole ? `${rising.length} layers` : `layers ${a + 1} to ${b + 1}`;
    };
    for (const input of [low, high]) input.addEventListener("input", apply);
    tools.append(el("span", { class: "layer-range" }, said, low, high));
    apply();
}

space.covers = [legend, ...(tools.children as unknown as HTMLElement[])];

const over = choice<Over>("strips over", [["time", "over time"], ["length", "over path length"]], (value) => {
    strips.set(value);
    strips.moveTo(player.time);
});
const stripTools = el("div", { class: "strip-tools" }, over, el("button", { title: "show all (double click)", click: () => strips.whole() }, "all"));

const s = report.summary;
const big = (name: string, value: string) => el("span", { class: "fact" }, el("small", {}, name), el("b", {}, value));
const header = el("header", {},
    el("h1", { title: report.program }, report.program.split("/").pop()!),
    ...(report.path.count ? [
        big("cycle time", `${number(s.cycle_time_s, 5)} s`),
        ...(s.cycle_time_s >= 60 ? [big("that is", duration(s.cycle_time_s))] : []),
        ...(s.optimum_time_s ? [big("optimum", `${number(s.optimum_time_s, 5)} s`)] : []),
        big("path length", `${number(s.length_mm, 5)} ${motion.lengthUnit}`),
        big("largest speed", `${number(s.max_speed_mm_s, 4)} ${motion.speedUnit}`),
        big("stops", String(s.stops)),
        ...(s.program?.dwells ? [big("dwells", String(s.program.dwells))] : []),
    ] : []),
    el("button", { class: "theme", title: "light or dark (d)", "aria-label": "light or dark", click: () => dress((dark = !dark)) }, "\u25d0"),
);
const banner = report.stopped ? el("div", { class: "banner", role: "alert" }, report.stopped) : "";

const moves = report.path.count > 0;
const contents: [string, boolean, () => HTMLElement][] = [
    ["Program", true, () => listing.element],
    ["Summary", moves, () => el("div", {}, panels.summary(motion), panels.tools(motion))],
    ["Limits", moves, () => panels.limits(motion)],
    ["Lines", moves, () => panels.costly(motion, go)],
    ["Stops", moves, () => panels.stops(motion, go)],
    ["Events", report.events.length + report.operated.length > 0, () => panels.events(motion, go)],
    ["Drives", Boolean(s.link), () => panels.drives(motion)],
    ["Layers", rising.length > 0, () => panels.layerTable(rising, go)],
];
const pages = contents.filter(([, there]) => there).map(([name, , make]) => ({ name, make, page: el("div", { class: "page" }) }));
const tabs = pages.map(({ name }, i) => el("button", { role: "tab", click: () => open(i) }, name));
/** Tables are made when they are asked for: the page opens sooner. */
function fill(i: number): void {
    if (!pages[i].page.firstChild) pages[i].page.append(pages[i].make());
}
function open(chosen: number): void {
    fill(chosen);
    pages.forEach(({ page }, i) => page.classList.toggle("open", i === chosen));
    tabs.forEach((tab, i) => tab.setAttribute("aria-selected", String(i === chosen)));
    listing.draw();
}

document.title = `${report.program} - splinefeed report`;
document.body.classList.toggle("still", !moves);
document.getElementById("app")!.append(
    header,
    ...(banner ? [banner] : []),
    el("main", {},
        el("section", { class: "picture" }, space.element, tools, legend),
        player.element,
        el("section", { class: "curves" }, strips.element, stripTools),
    ),
    el("aside", {}, readout.element, el("nav", { role: "tablist" }, ...tabs), el("div", { class: "pages" }, ...pages.map(({ page }) => page))),
);
open(report.lines.text.length || !moves ? 0 : 1);
dress(dark);
space.look(space.flat ? "top" : "free");
player.go(report.stopped ? motion.end : 0);

const keys: Record<string, () => void> = {
    " ": () => player.toggle(),
    ArrowRight: () => player.step(1),
    ArrowLeft: () => player.step(-1),
    ArrowUp: () => player.faster(1),
    ArrowDown: () => player.faster(-1),
    Home: () => go(0),
    End: () => go(motion.end),
    ",": () => go(player.time - 0.001),
    ".": () => go(player.time + 0.001),
    "1": () => space.look("free"),
    "2": () => space.look("top"),
    "3": () => space.look("front"),
    "4": () => space.look("side"),
    d: () => dress((dark = !dark)),
};
function print(prints: boolean): void {
    document.body.classList.toggle("printing", prints);
    pages.forEach((_, i) => fill(i));
    dress(dark && !prints);
    space.snap();
    strips.resize();
}
addEventListener("beforeprint", () => print(true));
addEventListener("afterprint", () => print(false));
addEventListener("keydown", (event) => {
    const tag = (event.target as HTMLElement).tagName;
    if (event.ctrlKey || event.metaKey || event.altKey || tag === "SELECT" || (tag === "INPUT" && event.key.startsWith("Arrow"))) return;
    if (tag === "BUTTON" && event.key === " ") return;
    const act = keys[event.key];
    if (act) {
        event.preventDefault();
        act();
    }
});
