// SPDX-License-Identifier: MIT
// Debian's chromium, driven by the playwright-core that bundle.sh has fetched; it draws by software, so everywhere the same.
import { existsSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

/** Ends the program as skipped, if something is missing. @param packages the page directory of bundle.sh */
export async function launched(packages) {
    const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
    const driver = join(packages, "node_modules/playwright-core/index.mjs");
    for (const [there, what] of [[executablePath, "chromium is not installed"], [existsSync(driver), "there is no playwright-core (report_bundle)"]]) {
        if (!there) {
            console.log(`SKIPPED: ${what}`);
            process.exit(77);
        }
    }
    const { chromium } = await import(pathToFileURL(resolve(driver)));
    return chromium.launch({ executablePath, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
}

/** A page without a network. */
export async function offline(browser, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(120000);
    return page;
}
