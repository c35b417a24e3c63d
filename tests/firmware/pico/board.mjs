#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// A Pico as a process, for tests/firmware/board_in_node.py: board.mjs IMAGE SEED. It reads requests as lines of JSON, {"do": ...}, and answers each with a line.
// Its time stands still but in "run". The answer: { ns, said, usb, edges: [[ns, pin, level], ...], powered, resets }, of what came since the
// one before; or { error }.
import { readFileSync, writeFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { FirmwareError, Pico } from "./rp2040.mjs";

const [image, seed] = process.argv.slice(2);
const pico = new Pico({ seed: Number(seed) });
pico.load(image);
pico.powerUp();
const delivered = Uint8Array.from(pico.flash.bytes);

const ACTIONS = {
    run: ({ ns }) => pico.run(pico.ns + ns),
    send: ({ text }) => pico.send(text),
    contact: ({ pin, level }) => pico.contact(pin, level),
    reset: () => pico.reset(),
    power_off: () => pico.powerOff(),
    power_up: () => pico.powerUp(),
    as_delivered: () => {
        pico.flash.bytes.set(delivered);
        pico.powerUp();
    },
    cut_after: ({ steps }) => pico.flash.cutAfter(steps),
    save_flash: ({ path }) => writeFileSync(path, pico.flash.bytes),
    load_flash: ({ path }) => pico.flash.bytes.set(readFileSync(path)),
    usb_attach: () => pico.usb.attach(),
    usb_detach: () => pico.usb.detach(),
    usb_read: ({ reading }) => pico.usb.read(reading),
    usb_lines: ({ lines }) => pico.usb.setLines(lines),
    usb_send: ({ text }) => pico.usb.send(text),
    halt_at_edges: ({ count }) => {
        let left = count;
        pico.onEdge = () => --left > 0 || pico.stop();
    },
    go_on: () => { pico.onEdge = null; },
};

for await (const line of createInterface({ input: process.stdin })) {
    const request = JSON.parse(line);
    let answer;
    try {
        ACTIONS[request.do](request);
        answer = { ns: pico.ns, said: pico.takeSaid(), usb: pico.usb.takeSaid(), edges: pico.takeEdges().map(({ ns, pin, level }) => [ns, pin, level]),
                   powered: pico.powered, resets: pico.resets, overruns: pico.uart.overruns, steps: pico.flash.steps };
    } catch (problem) {
        answer = { error: problem instanceof FirmwareError ? problem.message : problem.stack };
    }
    process.stdout.write(`${JSON.stringify(answer)}\n`);
}
