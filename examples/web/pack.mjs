// SPDX-License-Identifier: MIT
// Puts the page together: node pack.mjs PLANNER.js OUTPUT. Beside PLANNER.js lies its .wasm.
import {readFileSync, writeFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {gzipSync} from "node:zlib";

const [planner, output] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const text = (name) => readFileSync(join(here, name), "utf8");
const packed = (bytes) => gzipSync(bytes, {level: 9}).toString("base64");

const parts = {
    PROGRAM: text("../bracket.ngc"),
    PLANNER: packed(readFileSync(planner.replace(/\.js$/, ".wasm"))),
    WORKER: packed(readFileSync(planner, "utf8") + text("worker.js")),
    PAGE: text("page.js"),
};
writeFileSync(output, text("page.html").replace(/@([A-Z]+)@/g, (_, name) => parts[name]));
