// SPDX-License-Identifier: MIT
// rp2040js, from the folder in which packages.sh has installed it: SPLINEFEED_PICO, otherwise build/release/pico.
import { resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const folder = process.env.SPLINEFEED_PICO ?? fileURLToPath(new URL("../../../build/release/pico", import.meta.url));
const part = (file) => import(pathToFileURL(resolve(folder, "node_modules/rp2040js/dist/esm", file)));

export const { RP2040, BasePeripheral, FIFO, USBCDC } = await part("index.js");
export const { SimulationClock } = await part("clock/simulation-clock.js");
export const { IRQ } = await part("irq.js");

/** What no Pico would have done: an error of the firmware, or something that is not modelled here. */
export class FirmwareError extends Error {}

/** Numbers of a seed: the same on every host (mulberry32). */
export function random(seed) {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let mixed = Math.imul(state ^ (state >>> 15), state | 1);
        mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
        return (mixed ^ (mixed >>> 14)) >>> 0;
    };
}
