#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// The planner in a page, in a browser without a network, beside the tool: page.mjs TOOL PAGE_DIRECTORY (which bundle.sh has filled) PAGE
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launched, offline } from "../report/browser.mjs";

const [tool, packages, html] = process.argv.slice(2);
const browser = await launched(packages);
const folder = mkdtempSync(join(tmpdir(), "web-"));

// What depends on the computer: times, memory, and the name that the page gives a machine.
const varying = [/"planning_time_s":[^,}]*/, /"peak_rss_bytes":\d+/, /"memory_bytes":\{[^}]*\}/, /"file":"[^"]*"/];
// The last digits of the largest speed, which an iteration finds, are others in a browser; all else is equal.
const rounded = (report) => report.replace(/"max_speed_mm_s":([\d.]+)/, (_, speed) => Number(speed).toPrecision(12));
const hashOf = (report) => createHash("sha256").update(varying.reduce((text, part) => text.replaceAll(new RegExp(part, "g"), ""), rounded(report))).digest("hex");

async function opened() {
    const page = await offline(browser);
    const wrong = [];
    page.on("pageerror", (error) => wrong.push(error.message));
    page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
    page.on("request", (request) => /^(file|blob):/.test(request.url()) || wrong.push(request.url()));
    await page.addInitScript(() => {
        const make = URL.createObjectURL;
        URL.createObjectURL = (blob) => {
            window.latest = blob.type === "text/html" ? blob : window.latest;
            return make.call(URL, blob);
        };
    });
    await page.goto(pathToFileURL(resolve(html)).href);
    return { page, wrong };
}

/** Fills the fields in, plans, and gives what the page says. */
async function planned(page, file, fields = {}) {
    for (const name of ["ignore", "tolerance", "zero", "max_velocity_mm_s", "max_acceleration_mm_s2", "max_jerk_mm_s3", "machine"]) {
        await page.fill(`#${name}`, fields[name] ?? "");
    }
    await page.selectOption("#dialect", fields.dialect ?? "auto");
    await page.setInputFiles("#file", []);
    await page.evaluate(() => delete document.body.dataset.status);
    await page.setInputFiles("#file", file);
    await page.waitForSelector("body[data-status]:not(.busy)");
    return { status: await page.getAttribute("body", "data-status"), said: await page.innerText("#said") };
}

const machine = resolve("examples/three_axis.toml");
const jerk = ["x", "y", "z"].flatMap((axis) => ["--set", `axis.${axis}.max_jerk_mm_s3=30000`]);
const inMachine = { fields: { machine: readFileSync(machine, "utf8") }, args: ["-m", machine] };
const inDefault = { fields: {}, args: ["-m", "default"] };
const withJerk = { fields: { max_jerk_mm_s3: "30000" }, args: ["-m", "default", ...jerk] };
const gcode = (of) => ({ fields: { ...of.fields }, args: [...of.args, "--dialect", "auto"] });
const programs = [
    ["bracket.ngc", gcode(inDefault)],
    ["bracket.ngc", gcode(withJerk)],
    ["nameplate.nc", gcode(inDefault)],
    ["ring.gcode", { fields: { ...inMachine.fields, dialect: "marlin", ignore: "E,unknown" }, args: [...inMachine.args, "--dialect", "marlin", "--ignore", "E,unknown"] }],
    ["wave.ngc", gcode(inMachine)],
    ["path61.csv", inMachine],
    ["star.csv", inDefault],
    ["circle720.csv", inDefault],
    ["square.csv", withJerk],
    ["cloud.csv", inDefault],
];

const tests = {
    async "ten programs: the reports are the tool's"() {
        const { page, wrong } = await opened();
        for (const [name, { fields, args }] of programs) {
            const file = resolve("examples", name);
            const report = join(folder, "report.html");
            execFileSync(resolve(tool), ["plan", name, ...args, "--report", report, "--quiet"], { cwd: resolve("examples"), stdio: "ignore" });
            const answer = await planned(page, file, fields);
            assert.equal(answer.status, "0", `${name}: ${answer.said}`);
            const shown = await page.evaluate(() => window.latest.text());
            writeFileSync(join(folder, "shown.html"), shown);
            assert.equal(hashOf(shown), hashOf(readFileSync(report, "utf8")), `${name}: its report is another one`);
        }
        await page.frameLocator("#report").locator(".space[data-tool]").waitFor(); // it is drawn, too
        assert.deepEqual(wrong, []);
    },
    async "a program that is wrong is refused with its line, and what is no program by its name"() {
        const { page } = await opened();
        const wrong = join(folder, "wrong.ngc");
        writeFileSync(wrong, "G21 G90\nG1 X10 F600\nG1 X20 Q\n");
        const refused = await planned(page, wrong);
        assert.equal(refused.status, "2");
        assert.match(refused.said, /^wrong\.ngc:3:8: /m);
        const picture = join(folder, "picture.png");
        writeFileSync(picture, "no program");
        assert.match((await planned(page, picture)).said, /does not say what it is/);
        assert.equal(await page.isHidden("#result"), true);
    },
    async "an option that the program does not have is refused, and any name of a file gets an answer"() {
        const { page } = await opened();
        const refused = await planned(page, resolve("examples/path61.csv"), { ignore: "M104" });
        assert.equal(refused.status, "2");
        assert.match(refused.said, /only a program in G-code has it/);
        for (const name of ["dev", "machine", "report.html"]) {
            const file = join(folder, name);
            writeFileSync(file, "<p>no program</p>");
            const answer = await planned(page, file);
            assert.notEqual(answer.status, "0");
            assert.match(answer.said, /^splinefeed: /);
            assert.equal(await page.isHidden("#result"), true);
        }
    },
    async "what a grbl answers to $$ is a machine"() {
        const { page } = await opened();
        const listing = "$100=80\n$101=80\n$102=400\n$110=6000\n$111=6000\n$112=600\n$120=300\n$121=300\n$122=50\n$130=300\n$131=300\n$132=80\n";
        const file = join(folder, "line.ngc");
        writeFileSync(file, "G21 G90 G1 X-10 Y-10 F3000\n");
        const answer = await planned(page, file, { machine: listing });
        assert.equal(answer.status, "0", answer.said);
    },
    async "a long program shows how far it is, and is cancelled"() {
        const { page } = await opened();
        const file = join(folder, "long.ngc");
        writeFileSync(file, "G21 G90 F6000\n" + Array.from({ length: 200000 }, (_, i) => `G1 X${(i * 7) % 50} Y${(i * 3) % 40}`).join("\n"));
        await page.setInputFiles("#file", file);
        await page.waitForFunction(() => / line \d+/.test(document.getElementById("said").textContent));
        await page.click("#cancel");
        assert.equal(await page.innerText("#said"), "Cancelled.");
    },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
    try {
        await test();
        console.log(`ok: ${name}`);
    } catch (error) {
        failed = 1;
        console.log(`FAILED: ${name}\n${error.message}`);
    }
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failed);
