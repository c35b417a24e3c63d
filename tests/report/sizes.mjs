#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Eight reports on a phone, a tablet and a screen: nothing is cut: sizes.mjs TOOL PAGE_DIRECTORY (which bundle.sh has filled) [SCREENSHOTS [REPORT]]
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launched, offline } from "./browser.mjs";
import { cut } from "./cut.mjs";

const [tool, packages, shots, only = ""] = process.argv.slice(2);
const browser = await launched(packages);
const folder = mkdtempSync(join(tmpdir(), "sizes-"));
const example = (name) => resolve("examples", name);
const file = (name, text) => (writeFileSync(join(folder, name), text), join(folder, name));
const three = ["-m", example("three_axis.toml")];
const axis = (name, more = "") => `[[axis]]\nname = "${name}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 800\nsteps_per_mm = 400\n${more}`;
const four = file("four.toml", `[path]\nmax_feed_mm_s = 60\n${axis("x", "travel_mm = [-10, 210]\n")}${axis("y", "travel_mm = [-10, 210]\n")}${axis("z", "travel_mm = [-80, 5]\n")}${axis("a", 'kind = "rotary"\n')}`);
const steered = file("steered.csv", "t,event,value\n0.1,override,0.5\n0.6,hold\n1,resume\n1.6,override,1\n");
const probe = "G21 G90 G94 F600\nT1 M6\nM3 S8000\nG0 X5 Y5 Z2\nG1 Z-1 F200\nG4 P0.5\nG1 X20 F900\nG1 Y20\nG4 P1.2\nG1 X5\nG38.2 Z-5 F50\nG0 Z5\nM5\nM2\n";
const turning = "G21 G90 G94\nG1 X50 F600\nG1 X100 A90 F600\nG1 Y30 A180\nG0 A0\nM2\n";

const reports = {
    lines: () => ["run", example("path61.csv"), ...three],
    print: () => ["plan", example("ring.gcode"), ...three, "--dialect", "marlin", "--ignore", "E,unknown"],
    raster: () => ["plan", example("raster3d.csv"), ...three],
    rotary: () => ["plan", file("turning.ngc", turning), "-m", four],
    steered: () => ["run", example("path61.csv"), ...three, "--events", steered],
    dwells: () => ["run", file("a_program_with_dwells_and_a_probe_whose_name_is_rather_long.ngc", probe), ...three],
    blocks: () => ["plan", file("blocks.gcode", execFileSync("bench/slicer.py", ["100000"], { maxBuffer: 1 << 26 })), ...three, "--dialect", "marlin", "--ignore", "E", "--scalar", "double", "--no-advice"],
    surface: () => {
        const csv = join(folder, "dome.csv");
        execFileSync(tool, ["surface", example("dome.json"), "--along", "u", "--scallop", "0.05", "--ball-radius", "6", "-o", csv], { stdio: "ignore" });
        return ["plan", csv];
    },
};
const sizes = [[390, 844], [1024, 768], [1600, 900]];

let failed = 0;
if (shots) mkdirSync(shots, { recursive: true });
for (const [name, arguments_of] of Object.entries(reports).filter(([name]) => name.includes(only))) {
    const html = join(folder, `${name}.html`);
    const run = spawnSync(tool, [...arguments_of(), "--report", html, "--quiet"], { encoding: "utf8" });
    const wrong = run.status === 0 ? [] : [run.stderr];
    const page = await offline(browser, { hasTouch: true });
    page.on("pageerror", (error) => wrong.push(error.message));
    if (run.status === 0) await page.goto(pathToFileURL(html).href);
    for (const [width, height] of run.status === 0 ? sizes : []) {
        await page.setViewportSize({ width, height });
        await page.waitForSelector('.space[data-drawn="all"]');
        for (const tab of await page.locator("nav button").all()) {
            await tab.click();
            await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
            wrong.push(...(await page.evaluate(cut)).map((what) => `${width} px: ${what}`));
            if (shots) await page.screenshot({ path: join(shots, `${name}-${width}-${await tab.innerText()}.png`), fullPage: true });
        }
        await page.locator("nav button").first().click();
    }
    await page.context().close();
    failed += wrong.length ? 1 : 0;
    console.log(wrong.length ? `FAILED: ${name}\n${[...new Set(wrong)].slice(0, 20).join("\n")}` : `ok: ${name}`);
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failed ? 1 : 0);
