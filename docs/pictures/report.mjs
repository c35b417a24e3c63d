#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Makes the README's picture, report.png: report.mjs BUILD_DIRECTORY. Needs chromium and what tests/report/bundle.sh has fetched.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { launched, offline } from "../../tests/report/browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const build = resolve(process.argv[2]);
const examples = join(here, "../../examples");
const browser = await launched(join(build, "report_page"));
const folder = mkdtempSync(join(tmpdir(), "picture-"));
const html = join(folder, "page.html");
execFileSync(join(build, "bin/splinefeed"), ["plan", join(examples, "butterfly.json"), "-m", join(examples, "jerk_limited.toml"), "--report", html, "--quiet"]);
const page = await offline(browser, { colorScheme: "light" });
await page.goto(pathToFileURL(html).href);
await page.selectOption('select[aria-label="colours of the path"]', "limit");
await page.click('nav >> text="Limits"');
await page.fill('input[aria-label="time"]', "3570"); // of 10000
await page.waitForSelector('.space[data-drawn="all"]');
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
await page.screenshot({ path: join(here, "report.png") });
await browser.close();
rmSync(folder, { recursive: true });
