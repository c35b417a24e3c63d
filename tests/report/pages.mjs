#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Pages of reports in a browser, without a network: pages.mjs TOOL PAGE_DIRECTORY (which bundle.sh has filled) [SCREENSHOTS [TEST]]
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launched, offline } from "./browser.mjs";
import { cut } from "./cut.mjs";

const [tool, packages, shots, only = ""] = process.argv.slice(2);
const browser = await launched(packages);
const folder = mkdtempSync(join(tmpdir(), "report-"));
const examples = resolve("examples");
if (shots) mkdirSync(shots, { recursive: true });

/** Runs the tool; gives the page and the summary. */
function made(name, args, { input, status = 0, command = "run" } = {}) {
    const html = join(folder, `${name}.html`);
    const run = spawnSync(tool, [command, ...args, "--report", html, "--summary", "json", "--quiet"], { input, encoding: "utf8", maxBuffer: 1 << 26 });
    assert.equal(run.status, status, run.stderr);
    return { html, summary: JSON.parse(run.stdout) };
}

/** Opens a page offline; what is wrong on it, or asked for from elsewhere, fails. */
async function open(html, theme = "light", options = {}) {
    const page = await offline(browser, { colorScheme: theme, ...options });
    const wrong = [];
    page.on("pageerror", (error) => wrong.push(error.message));
    page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
    page.on("dialog", (dialog) => (wrong.push(`dialog: ${dialog.message()}`), dialog.dismiss()));
    page.on("request", (request) => request.url().startsWith("file:") || request.url().startsWith("blob:") || wrong.push(request.url()));
    await page.goto(pathToFileURL(html).href);
    await page.waitForSelector(".space[data-tool]");
    assert.deepEqual(wrong, []);
    return { page, wrong, close: () => page.context().close() };
}

const fact = (page, name) => page.locator(".fact", { has: page.locator(`small:text-is("${name}")`) }).locator("b").innerText();
const now = (page, name) => page.locator(".now > span", { has: page.locator(`small:text-is("${name}")`) }).innerText().then((text) => text.split("\n").pop());
const time = async (page) => parseFloat(await now(page, "time"));
const tab = (page, name) => page.click(`nav >> text="${name}"`);
const close = (a, b, share = 1e-3) => assert.ok(Math.abs(a - b) <= share * Math.max(Math.abs(a), Math.abs(b)) + 1e-9, `${a} is not ${b}`);

const tests = {
    async "path61: figures, line to place, place to line, playing, zoom, colours"() {
        const { html, summary } = made("path61", [join(examples, "path61.csv"), "-m", join(examples, "three_axis.toml")]);
        const { page, wrong, close: end } = await open(html);
        close(parseFloat(await fact(page, "cycle time")), summary.cycle_time_s);
        close(parseFloat(await fact(page, "optimum")), summary.optimum_time_s);
        close(parseFloat(await fact(page, "path length")), summary.length_mm);
        close(parseFloat(await fact(page, "largest speed")), summary.max_speed_mm_s);
        // Nothing scrolls.
        assert.deepEqual(await page.evaluate(() => [document.documentElement.scrollHeight, document.documentElement.scrollWidth]), [800, 1280]);
        // Line to place, and back.
        await page.click('.row[data-line="20"]');
        const t = await time(page);
        assert.ok(t > 0 && t < summary.cycle_time_s);
        const before = await page.getAttribute(".space", "data-tool");
        await page.keyboard.press("ArrowRight");
        await page.waitForFunction((old) => document.querySelector(".space").dataset.tool !== old, before);
        assert.ok((await time(page)) > t);
        const line = Number(await now(page, "line"));
        assert.ok(line === 21 || line === 20, `line ${line}`);
        await page.waitForTimeout(1000);
        const [x, y] = (await page.getAttribute(".space", "data-tool")).split(" ").map(Number);
        const place = await time(page);
        await page.keyboard.press("Home");
        assert.equal(await time(page), 0);
        await page.mouse.click(x, y + (await page.locator(".space").boundingBox()).y);
        close(await time(page), place, 0.02);
        // Play, pause.
        await page.keyboard.press("Home");
        await page.click('button[aria-label="play"]');
        await page.waitForFunction(() => parseFloat(document.querySelector(".now").textContent.replace("time", "")) > 0.05);
        await page.click('button[aria-label="pause"]');
        const paused = await time(page);
        await page.waitForTimeout(300);
        assert.equal(await time(page), paused);
        // Zoom of the strips, and all of it again.
        const over = page.locator(".u-over").first();
        await over.hover();
        await page.mouse.wheel(0, -600);
        await page.waitForFunction(() => document.querySelector(".strips").dataset.range);
        const [from, to] = (await page.getAttribute(".strips", "data-range")).split(" ").map(Number);
        assert.ok(to - from < 0.6 * summary.cycle_time_s, `${from} to ${to}`);
        await over.dblclick();
        const whole = (await page.getAttribute(".strips", "data-range")).split(" ").map(Number);
        close(whole[1] - whole[0], summary.cycle_time_s, 0.01);
        await page.selectOption('select[aria-label="strips over"]', "length");
        // Colours: the legend says what they are.
        for (const [quantity, said] of [["limit", "feed"], ["acceleration", "% of the limit"], ["feed", "programmed feed"], ["speed", "mm/s"]]) {
            await page.selectOption('select[aria-label="colours of the path"]', quantity);
            assert.match(await page.innerText(".legend"), new RegExp(said));
        }
        for (const key of ["2", "3", "4", "1", "d", "d"]) await page.keyboard.press(key);
        await tab(page, "Limits");
        const share = await page.locator(".page.open tbody tr").nth(1).locator("td").nth(2).innerText();
        close(parseFloat(share), 100 * summary.limit_share.acceleration.y, 0.02);
        assert.deepEqual(wrong, []);
        await end();
    },

    async "a program in G-code: lines, stops, events, tool"() {
        const { html, summary } = made("bracket", [join(examples, "bracket.ngc"), "-m", join(examples, "three_axis.toml")]);
        const { page, wrong, close: end } = await open(html);
        await tab(page, "Lines");
        const first = await page.locator(".page.open tbody tr").first().locator("td").allInnerTexts();
        await page.locator(".page.open tbody tr").first().click();
        assert.equal(await now(page, "line"), first[0]);
        await tab(page, "Stops");
        assert.equal(await page.locator(".page.open tbody tr").count(), summary.stops);
        assert.match(await page.innerText(".page.open h3"), new RegExp(`^${summary.stops} stops on the way$`));
        assert.match(await page.innerText(".page.open"), /corner of|dwell|exact stop/);
        assert.equal(await fact(page, "stops"), String(summary.stops));
        assert.equal(await fact(page, "dwells"), String(summary.program.dwells));
        await tab(page, "Events");
        assert.ok((await page.locator(".page.open tbody tr").count()) >= summary.program.events);
        assert.match(await page.innerText(".modal"), /tool 1/);
        await end();
        assert.deepEqual(wrong, []);
    },

    async "a tablet and a phone: nothing lies outside its place; and two printed sheets, light ones"() {
        const { html } = made("sizes", [join(examples, "bracket.ngc"), "-m", join(examples, "three_axis.toml")]);
        const { page, wrong, close: end } = await open(html, "dark", { viewport: { width: 1024, height: 768 }, hasTouch: true });
        assert.deepEqual(await page.evaluate(() => [document.documentElement.scrollHeight, document.documentElement.scrollWidth]), [768, 1024]);
        assert.deepEqual(await page.evaluate(cut), []);
        await page.setViewportSize({ width: 390, height: 844 });
        for (const name of ["Stops", "Lines", "Program"]) {
            await tab(page, name);
            await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
            assert.deepEqual(await page.evaluate(cut), [], name);
        }
        await page.setViewportSize({ width: 1024, height: 768 });
        await page.locator(".space").tap({ position: { x: 300, y: 200 } });
        await page.evaluate(() => addEventListener("beforeprint", () => (document.title = `${document.documentElement.dataset.theme} ${document.querySelectorAll(".page tbody").length}`)));
        const sheets = (await page.pdf({ preferCSSPageSize: true, printBackground: true })).toString("latin1").match(/\/Type\s*\/Page\b/g);
        assert.equal(sheets.length, 2);
        assert.match(await page.title(), /^light [5-9]/);
        await page.waitForFunction(() => document.documentElement.dataset.theme === "dark" && !document.body.classList.contains("printing"));
        await end();
        assert.deepEqual(wrong, []);
    },

    async "a jerk limit: four strips"() {
        const { html } = made("butterfly", [join(examples, "butterfly.json"), "-m", join(examples, "jerk_limited.toml")]);
        const { page, wrong, close: end } = await open(html, "dark");
        assert.equal(await page.locator(".strip").count(), 4);
        assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
        await end();
        assert.deepEqual(wrong, []);
    },

    async "six axes"() {
        const axis = (name, rotary) => `[[axis]]\nname = "${name}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 800\nsteps_per_mm = 400\n${rotary ? 'kind = "rotary"\n' : ""}`;
        const machine = join(folder, "six.toml");
        writeFileSync(machine, `[path]\nmax_feed_mm_s = 60\n${["x", "y", "z"].map((n) => axis(n, false)).join("")}${["a", "b", "c"].map((n) => axis(n, true)).join("")}`);
        const rows = Array.from({ length: 30 }, (_, i) => [40 * Math.cos(i / 4), 40 * Math.sin(i / 4), i, 30 * Math.sin(i / 3), 2 * i, -i].map((v) => v.toFixed(4)).join(","));
        const { html, summary } = made("six", ["-", "-m", machine], { input: `x,y,z,a,b,c\n${rows.join("\n")}\n` });
        const { page, wrong, close: end } = await open(html);
        assert.equal(await page.locator(".readout tbody tr").count(), 6);
        assert.match(await page.innerText(".readout thead"), /velocity \[mm\/s, deg\/s\]/);
        close(parseFloat(await fact(page, "cycle time")), summary.cycle_time_s);
        const way = rows.slice(1).reduce((sum, row, i) => sum + Math.hypot(...[0, 1, 2].map((k) => row.split(",")[k] - rows[i].split(",")[k])), 0);
        close(summary.length_mm, way, 0.02); // of the curve; with the degrees it would be four times as long
        await end();
        assert.deepEqual(wrong, []);
    },

    async "what an operator did, and a run that ended early"() {
        const events = join(folder, "events.csv");
        writeFileSync(events, "t,event,value\n0.1,override,0.5\n0.6,hold\n1,resume\n1.6,abort\n");
        const { html, summary } = made("events", [join(examples, "path61.csv"), "--events", events], { status: 1 });
        const { page, wrong, close: end } = await open(html);
        assert.match(await page.innerText(".banner"), /aborted/);
        assert.match(await page.innerText(".modal"), /override 50 %/);
        await tab(page, "Events");
        assert.match(await page.innerText(".page.open"), /override[\s\S]*hold[\s\S]*resume[\s\S]*abort/);
        // One figure: the legend has that of the tab and of the summary; a hold is no stop.
        await tab(page, "Stops");
        assert.equal(await page.locator(".page.open tbody tr").count(), summary.stops);
        close(parseFloat(await fact(page, "path length")), summary.length_mm);
        const { hold, override } = summary.limit_share;
        assert.ok(hold > 0.2 && override > 0.05, JSON.stringify(summary.limit_share));
        await tab(page, "Limits");
        await page.selectOption('select[aria-label="colours of the path"]', "limit");
        for (const [name, share] of Object.entries({ hold, override })) {
            const said = new RegExp(`${name}\\s+${(100 * share).toFixed(1)}\\s%`);
            assert.match(await page.innerText(".legend"), said);
            assert.match(await page.innerText(".page.open"), said);
        }
        await end();
        assert.deepEqual(wrong, []);
    },

    async "a program that check finds wrong: what it says, and the moves that were understood"() {
        const program = join(folder, "wrong.ngc");
        writeFileSync(program, "G21\nG0 X5\nG1 X10 Y5 F600\nG77 X3\nG1 X20 Y0\n");
        const html = join(folder, "wrong.html");
        const run = spawnSync(tool, ["check", program, "--report", html], { encoding: "utf8" });
        assert.equal(run.status, 1, run.stderr);
        const { page, wrong, close: end } = await open(html);
        assert.match(await page.innerText(".banner"), /wrong\.ngc:4:/);
        assert.match(await page.innerText('.row[data-line="4"]'), /G77/);
        await end();
        assert.deepEqual(wrong, []);
    },

    async "a run on drives: their links, what they had buffered and how late they were"() {
        const ports = [0, 1, 2].map((k) => 20000 + (process.pid % 10000) * 3 + k);
        const machine = join(folder, "drives.toml");
        writeFileSync(machine, readFileSync(join(examples, "three_drives.toml"), "utf8").replace(/:150([234])/g, (_, n) => `:${ports[n - 2]}`));
        const drives = ports.map((port) => spawn(tool, ["drive", "--axes", "1", "--listen", `tcp://127.0.0.1:${port}`], { stdio: "ignore" }));
        try {
            await new Promise((done) => setTimeout(done, 1000));
            const { html, summary } = made("drives", [join(examples, "path61.csv"), "-m", machine, "--target", "modbus"]);
            const { page, wrong, close: end } = await open(html);
            assert.equal(await page.locator(".strip").count(), 4);
            await tab(page, "Drives");
            const rows = await page.locator(".page.open tbody tr").allInnerTexts();
            const segments = rows.map((row) => row.split("\t")).find(([name]) => name === "segments");
            assert.deepEqual(segments.slice(1).map(Number), summary.link.drives.map((drive) => drive.segments));
            const text = await page.innerText(".page.open");
            assert.ok(parseFloat(text.match(/least buffered\s+([\d.]+) ms/)[1]) > 10, text);
            assert.match(text, new RegExp(`stopped together\\s+${summary.link.resumes} time`));
            assert.match(text, /latest\s+[\d.]+ ms/);
            await end();
            assert.deepEqual(wrong, []);
        } finally {
            for (const drive of drives) drive.kill();
        }
    },

    async "texts are no markup"() {
        const program = join(folder, "<script>alert(1)<.csv");
        writeFileSync(program, "# </script><script>alert(2)</script><img src=x onerror=alert(3)>\nx,y\n0,0\n10,5\n20,0\n");
        const { html } = made("markup", [program]);
        const { page, wrong, close: end } = await open(html);
        assert.match(await page.innerText("h1"), /<script>alert\(1\)<\.csv$/);
        assert.match(await page.innerText('.row[data-line="1"]'), /<\/script><script>alert\(2\)/);
        assert.equal(await page.locator("img").count(), 0);
        assert.ok(!readFileSync(html, "utf8").includes("<script>alert"));
        await end();
        assert.deepEqual(wrong, []);
    },

    async "layers of a printed program"() {
        const program = join(folder, "rings.gcode");
        writeFileSync(program, execFileSync("bench/slicer.py", ["1500"]));
        const { html } = made("rings", [program, "--dialect", "marlin", "--ignore", "E", "-m", join(examples, "three_axis.toml"), "--scalar", "double"], { command: "plan" });
        const { page, wrong, close: end } = await open(html);
        await tab(page, "Layers");
        assert.match(await page.innerText(".page.open h3"), /13 layers/);
        await page.fill('input[aria-label="highest layer"]', "4");
        assert.match(await page.innerText(".layer-range output"), /layers 1 to 5/);
        // Beads as wide as the filament makes them: 0.0321 mm of it on 1 to 1.2 mm, 0.2 mm high.
        const widths = (await page.getAttribute(".space", "data-beads")).split(" ").map(Number);
        assert.ok(widths.length > 0 && widths.every((width) => width > 0.3 && width < 0.41), String(widths));
        assert.equal(await page.isChecked('label:has-text("program") input'), false);
        // Means of many bins; within a zoom each of them, and the zoom follows the player.
        assert.equal(await page.getAttribute(".strips", "data-drawn"), "means");
        await page.locator(".u-over").first().hover();
        await page.mouse.wheel(0, -3000);
        await page.waitForSelector('.strips[data-drawn="bins"]');
        const range = async () => (await page.getAttribute(".strips", "data-range")).split(" ").map(Number);
        const [from, to] = await range();
        await page.keyboard.press("End");
        const [a, b] = await range();
        const t = await time(page);
        assert.ok(a > to && t >= a && t <= b + 1e-6, `${t} in ${a} to ${b}, from ${from} to ${to}`);
        close(b - a, to - from, 1e-6);
        await end();
        assert.deepEqual(wrong, []);
    },

    async "a tall print: its layers and its speeds are those of the run, though the path is thinned"() {
        const [count, spacing] = [4500, 0.05];
        const ring = Array.from({ length: 9 }, (_, i) => (i * Math.PI) / 4).map((a) => `G1 X${(3 * Math.cos(a)).toFixed(3)} Y${(3 * Math.sin(a)).toFixed(3)}`).join("\n");
        const hop = (z) => `G1 Z${(z + 0.3).toFixed(2)}\nG1 X1\nG1 Z${z.toFixed(2)}\n`; // between two places of a layer
        const rings = Array.from({ length: count }, (_, i) => [i, spacing * (i + 1)]).map(([i, z]) => `G1 Z${z.toFixed(2)}\n${ring}\n${i % 100 === 50 ? hop(z) : ""}`);
        const program = join(folder, "tall.gcode");
        writeFileSync(program, `G21\nG90\nG1 F3000\n${rings.join("")}`);
        const { html, summary } = made("tall", [program, "--dialect", "marlin", "-m", join(examples, "three_axis.toml"), "--scalar", "double", "--no-advice"], { command: "plan" });
        const { page, wrong, close: end } = await open(html);
        const data = JSON.parse(await page.evaluate(() => document.getElementById("data").textContent));
        assert.ok(4 * data.path.tolerance > spacing, `thinned to ${data.path.tolerance} mm`);
        await tab(page, "Layers");
        assert.match(await page.innerText(".page.open h3"), new RegExp(`^${count} layers$`));
        const layer = (await page.locator(".page.open tbody tr").nth(2999).locator("td").allInnerTexts()).map(parseFloat);
        close(layer[1], 3000 * spacing, 1e-4);
        close(layer[2], summary.cycle_time_s / count, 0.02);
        close(parseFloat((await page.innerText(".legend")).split("\n").pop()), summary.max_speed_mm_s);
        // Only some layers, and what is picked is one of them.
        await page.keyboard.press("3");
        const box = await page.locator(".space").boundingBox();
        for (const name of ["lowest", "highest"]) await page.fill(`input[aria-label="${name} layer"]`, name === "lowest" ? "2000" : "2499");
        await page.mouse.click(box.x + box.width / 2, box.y + 0.9 * box.height); // below them
        assert.equal(await time(page), 0);
        await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
        const part = (await time(page)) / summary.cycle_time_s;
        assert.ok(part > 0.44 && part < 0.56, `at ${part} of the time`);
        await end();
        assert.deepEqual(wrong, []);
    },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
    if (!name.includes(only)) continue;
    try {
        await test();
        console.log(`ok: ${name}`);
    } catch (error) {
        ++failed;
        console.log(`FAILED: ${name}\n${error.stack}`);
    }
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failed ? 1 : 0);
