#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// How long a page of a report takes to open, and to turn: open_page.mjs PAGE_DIRECTORY (which tests/report/bundle.sh has filled) PAGE.html.
// One line: seconds to the first picture, seconds to all of it, milliseconds a frame while it is turned, and those from a turn of the wheel over the strips,
// and over the picture, until it is drawn (the median of 12); each the least of three.
import { pathToFileURL } from "node:url";
import { launched, offline } from "../tests/report/browser.mjs";

const [packages, file] = process.argv.slice(2);
const browser = await launched(packages);
const frame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const figures = [];

/** Zooms in, and out again. */
function wheel(page, selector) {
    return page.evaluate(async (selector) => {
        const over = document.querySelector(selector);
        const box = over.getBoundingClientRect();
        const times = [];
        for (let i = 0; i < 12; ++i) {
            const begin = performance.now();
            over.dispatchEvent(new WheelEvent("wheel", { deltaY: i < 6 ? -100 : 100, clientX: box.left + box.width / 3, clientY: box.top + box.height / 2, bubbles: true, cancelable: true }));
            await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
            times.push(performance.now() - begin);
        }
        return times.sort((a, b) => a - b)[6];
    }, selector);
}

for (let round = 0; round < 3; ++round) {
    const page = await offline(browser);
    const begin = performance.now();
    await page.goto(pathToFileURL(file).href);
    await page.waitForSelector(".space[data-tool]");
    await frame(page);
    const first = performance.now();
    await page.waitForSelector('.space[data-drawn="all"]');
    await frame(page);
    const all = performance.now();
    const box = await page.locator(".space").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    const turns = performance.now();
    const frames = 20;
    for (let i = 1; i <= frames; ++i) {
        await page.mouse.move(box.x + box.width / 2 + 5 * i, box.y + box.height / 2 + 2 * i);
        await page.evaluate(() => new Promise(requestAnimationFrame));
    }
    const turning = (performance.now() - turns) / frames;
    await page.mouse.up();
    await page.waitForSelector('.space[data-drawn="all"]');
    figures.push([(first - begin) / 1000, (all - begin) / 1000, turning, await wheel(page, ".u-over"), await wheel(page, ".space canvas")]);
    await page.context().close();
}
await browser.close();
console.log(figures[0].map((_, k) => Math.min(...figures.map((of) => of[k])).toFixed(3)).join(" "));
