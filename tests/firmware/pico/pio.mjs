// SPDX-License-Identifier: MIT
// A PIO of rp2040js in the time of its chip. Its own run() steps all four machines by the host's timer, without delays; here a cycle is stepped
// when the chip has come to it. OUT with autopull, delays and the joined FIFO are as the datasheet has them (3.5.4, 3.2.4, 3.5.3).
import { FIFO, FirmwareError } from "./emulator.mjs";

const AUTOPULL = 1 << 17;
const FJOIN_TX = 2 ** 30;
const TXSTALL = 1 << 24; // of FDEBUG, machine 0

/** The condition of a JMP to itself, without delay and side-set. */
const ALWAYS = 0x00, COUNTS_X = 0x40, COUNTS_Y = 0x80;
const loop = (machine, opcode) => ((opcode & 0xff1f) === machine.pc && !machine.execValid ? opcode & 0xe0 : null);

export class PioCycles {
    /** @param edges is called when pins may have changed, before anything else happens. `skips`: idle cycles are passed in one go. */
    constructor(pio, edges, skips) {
        Object.assign(this, { pio, edges, skips, cycle: 0, next: Infinity });
        pio.run = () => {};
        pio.stop = () => {};
        for (const machine of pio.machines) {
            machine.accounted = 0; // of machine.cycles: what is beyond is a delay
            machine.outputShiftCount = 32; // its OSR is empty
            this.#watchJoin(machine);
        }
    }

    /** JOIN gives TX the storage of RX, and empties both. */
    #watchJoin(machine) {
        const write = machine.writeUint32.bind(machine);
        machine.writeUint32 = (offset, value) => {
            const before = machine.shiftCtrl;
            write(offset, value);
            if ((before ^ machine.shiftCtrl) & FJOIN_TX) {
                machine.txFIFO = new FIFO(machine.shiftCtrl & FJOIN_TX ? 8 : 4);
                machine.rxFIFO.reset();
                machine.updateDMATx();
            }
        };
    }

    /** A register or a pin may be read or written in this cycle, which the machines have done. */
    comeTo(cycle) {
        if (cycle >= this.cycle) {
            this.#pass(cycle + 1 - this.cycle);
            this.cycle = cycle + 1;
        }
    }

    /** Behind what may have changed something: looks at all of it from there on. */
    touched() {
        for (const machine of this.pio.machines) {
            machine.accounted = Math.min(machine.accounted, machine.cycles);
            if (machine.enabled && (machine.clockDivInt !== 1 || machine.clockDivFrac !== 0)) {
                throw new FirmwareError(`PIO: a clock divider of ${machine.clockDivInt}, only 1 is modelled`);
            }
        }
        this.next = this.pio.machines.some((machine) => machine.enabled) ? this.cycle : Infinity;
        this.#show();
    }

    /** The cycle `next`, at which something may happen. */
    step() {
        this.#pass(this.next - this.cycle);
        this.cycle = this.next + 1; // an edge is an input, too, and touches
        let idle = Infinity;
        for (const machine of this.pio.machines) {
            if (machine.enabled) {
                this.#stepMachine(machine);
            }
        }
        this.#show();
        for (const machine of this.pio.machines) {
            if (machine.enabled) {
                idle = Math.min(idle, this.skips ? this.#idleCycles(machine) : 0);
            }
        }
        this.next = this.cycle + idle;
    }

    #show() {
        const { pio } = this;
        const changed = (pio.pinValues ^ pio.oldPinValues) | (pio.pinDirections ^ pio.oldPinDirections);
        if (changed) {
            pio.oldPinValues = pio.pinValues;
            pio.oldPinDirections = pio.pinDirections;
            this.edges(changed);
        }
    }

    #stepMachine(machine) {
        if (machine.cycles > machine.accounted) {
            ++machine.accounted;
        } else if (machine.waiting) {
            machine.checkWait();
        } else {
            const opcode = this.pio.instructions[machine.pc];
            if (opcode >>> 13 === 3 && this.#empty(machine)) { // OUT: an empty OSR costs it a cycle, or all until a word comes
                if (machine.txFIFO.empty) {
                    this.pio.txStall |= TXSTALL << machine.index;
                    this.pio.fdebug |= TXSTALL << machine.index;
                }
            } else {
                const before = machine.cycles;
                machine.updatePC = true;
                machine.executeInstruction(opcode);
                if (machine.updatePC) {
                    machine.nextPC();
                }
                machine.accounted = before + 1;
            }
        }
        if (!machine.txFIFO.empty && this.#empty(machine)) {
            machine.outputShiftReg = machine.txFIFO.pull();
            machine.outputShiftCount = 0;
            machine.updateDMATx();
            this.pio.checkInterrupts();
        }
    }

    #empty(machine) {
        return (machine.shiftCtrl & AUTOPULL) !== 0 && machine.outputShiftCount >= machine.pullThreshold;
    }

    /** So many of the next cycles change nothing but a count. */
    #idleCycles(machine) {
        if (machine.cycles > machine.accounted) {
            return machine.cycles - machine.accounted;
        }
        if (machine.waiting) {
            return Infinity; // for a FIFO, a pin or a flag: what changes them touches
        }
        const opcode = this.pio.instructions[machine.pc];
        if (opcode >>> 13 === 3 && this.#empty(machine)) {
            return machine.txFIFO.empty ? Infinity : 0;
        }
        const condition = loop(machine, opcode);
        return condition === COUNTS_X ? machine.x : condition === COUNTS_Y ? machine.y : condition === ALWAYS ? Infinity : 0;
    }

    #pass(count) {
        if (count <= 0) {
            return;
        }
        for (const machine of this.pio.machines) {
            if (!machine.enabled) {
                continue;
            }
            const opcode = this.pio.instructions[machine.pc];
            if (machine.cycles > machine.accounted) {
                machine.accounted += count;
            } else if (!machine.waiting) {
                const condition = loop(machine, opcode);
                machine.x -= condition === COUNTS_X ? count : 0;
                machine.y -= condition === COUNTS_Y ? count : 0;
            }
        }
    }
}
