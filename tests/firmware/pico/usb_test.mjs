#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// UsbSerial on the emulated chip, by usb_echo.cpp: usb_test.mjs IMAGE. A host enumerates it, sends and reads 100,000 bytes, stops reading, resets the bus, and
// closes, opens and pulls it out.
import assert from "node:assert/strict";
import { Pico } from "./rp2040.mjs";

const MS = 1e6, OPEN = 2, SESSION = 3;
const pico = new Pico({ seed: 3 });
pico.load(process.argv[2]);
pico.usb.attached = true;
pico.powerUp();

const levels = new Map([[OPEN, 0], [SESSION, 0]]);
function run(ms) {
    pico.run(pico.ns + ms * MS);
    for (const { pin, level } of pico.takeEdges()) {
        levels.set(pin, level);
    }
}
function runUntil(what, ms, done) {
    const end = pico.ns + ms * MS;
    while (!done()) {
        assert.ok(pico.ns < end, `${what}: not after ${ms} ms`);
        run(1);
    }
}
const isOpen = () => levels.get(OPEN) === 1;
const series = (size, from = 0) => String.fromCharCode(...Array.from({ length: size }, (_, i) => (from + i * 7 + (i >> 8) * 13) & 255));

function echoes(size) {
    const text = series(size, size);
    let said = "";
    for (let at = 0; at < size; at += 4096) {
        pico.usb.send(text.slice(at, at + 4096));
        runUntil("the echo", 200, () => (said += pico.usb.takeSaid()).length >= Math.min(at + 4096, size));
    }
    run(2);
    assert.equal(said + pico.usb.takeSaid() === text, true, `${size} bytes come back otherwise`);
}

runUntil("enumerated and opened", 50, isOpen);
console.log(`open after ${(pico.ns / MS).toFixed(1)} ms`);
const begin = pico.ns;
echoes(100_000);
console.log(`100,000 bytes both ways in ${((pico.ns - begin) / MS).toFixed(0)} ms`);

// A host that stops reading: the firmware takes no more than it has room for; nothing is lost.
pico.usb.read(false);
const kept = series(1000, 5);
pico.usb.send(kept);
run(50);
assert.equal(pico.usb.takeSaid(), "");
assert.ok(pico.usb.heard.length >= 1000 - 5 * 64, "the firmware takes what it cannot answer");
assert.ok(isOpen());
pico.usb.read(true);
run(50);
assert.equal(pico.usb.takeSaid(), kept);

// Closed and opened: another sender, who reads nothing of the last one's.
const session = levels.get(SESSION);
pico.usb.setLines(0);
run(2);
assert.ok(!isOpen());
pico.usb.send("to nobody");
run(5);
assert.equal(pico.usb.takeSaid(), "");
pico.usb.setLines(3);
runUntil("opened", 5, isOpen);
assert.notEqual(levels.get(SESSION), session);
echoes(500);

// The bus is reset while bytes are under way.
pico.usb.send(series(5000));
run(2);
pico.usb.attach();
pico.usb.heard = [];
runUntil("reset", 15, () => !isOpen());
runUntil("opened again", 50, isOpen);
run(5);
pico.usb.takeSaid();
echoes(3000);

// The cable is pulled: closed after 3 ms, and put in again.
pico.usb.send(series(5000));
run(2);
pico.usb.detach();
run(2);
assert.ok(isOpen(), "closed before a frame is missed");
run(2);
assert.ok(!isOpen(), "a pulled cable is an open port");
run(20);
pico.usb.takeSaid();
pico.usb.attach();
run(15); // the emulated host sends frames before it resets: the device takes that for a bus that wakes up
runUntil("put in again", 50, isOpen);
pico.usb.takeSaid();
echoes(3000);
console.log("stopped, closed, reset, pulled: as it should");
