// SPDX-License-Identifier: MIT
// Makes dist/report.html, the page without its data, of src/ and the packages of the lock file: node build.mjs [OUTPUT]
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2] ?? join(here, "dist/report.html");
const read = (name) => readFileSync(join(here, name), "utf8");

const bundle = async (entry) => {
    const made = await build({
        entryPoints: [join(here, entry)],
        absWorkingDir: here,
        bundle: true,
        minify: true,
        write: false,
        format: "iife",
        target: "es2022",
        charset: "ascii",
        legalComments: "none",
    });
    return made.outputFiles[0].text.trim();
};
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const script = await bundle("src/main.ts");
const style = await bundle("src/style.css");
const licences = ["three", "uplot"].map((name) => `${name}\n\n${read(`node_modules/${name}/LICENSE`).trim().replaceAll("\u00a9", "(c)")}`).join("\n\n");
const parts = {
    POLICY: `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src data: blob:; base-uri 'none'; form-action 'none'`,
    STYLE: style,
    SCRIPT: script,
    LICENCES: licences,
};
const page = read("src/report.html").replace(/<!--(POLICY|STYLE|SCRIPT|LICENCES)-->/g, (_, name) => parts[name]);
if (/[^\x00-\x7f]/.test(page)) throw new Error("the page must be ASCII");
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
console.log(`${output}: ${(page.length / 1024).toFixed(0)} KiB`);
