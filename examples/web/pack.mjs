// SPDX-License-Identifier: MIT
// Puts the page together: node pack.mjs PLANNER.js OUTPUT. Beside PLANNER.js lies its .wasm. zopfli packs 5 % better than zlib.
import {execFileSync} from "node:child_process";
import {readFileSync, writeFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {gzipSync} from "node:zlib";

const [planner, output] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const text = (name) => readFileSync(join(here, name), "utf8");

// Four bytes are five letters of 85, without < and the backslash: a sixteenth less than base64. page.js reads them.
const letters = Array.from({length: 87}, (_, i) => String.fromCharCode(40 + i)).filter((letter) => letter !== "<" && letter !== "\\");
function packed(data) {
    const padded = Buffer.concat([data, Buffer.alloc(-data.length & 3)]);
    let out = `${data.length} `;
    for (let i = 0; i < padded.length; i += 4) {
        let word = padded.readUInt32BE(i);
        let five = "";
        for (let digit = 0; digit < 5; ++digit, word = Math.floor(word / 85)) {
            five = letters[word % 85] + five;
        }
        out += five;
    }
    return out;
}

const parts = {
    PROGRAM: text("../bracket.ngc"),
    PLANNER: packed(execFileSync("zopfli", ["--gzip", "--i5", "-c", planner.replace(/\.js$/, ".wasm")], {maxBuffer: 1e8})),
    WORKER: packed(gzipSync(readFileSync(planner, "utf8") + text("worker.js"), {level: 9})),
    PAGE: text("page.js"),
};
writeFileSync(output, text("page.html").replace(/@([A-Z]+)@/g, (_, name) => parts[name]));
