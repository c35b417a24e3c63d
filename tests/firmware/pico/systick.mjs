// SPDX-License-Identifier: MIT
// SysTick to the cycle (Armv6-M Architecture Reference Manual, "The system timer"): a period has RVR + 1 cycles, and a write of CVR interrupts nothing.
// rp2040js has a cycle less, and interrupts at such a write.
import { FirmwareError } from "./emulator.mjs";

const CSR = 0x10, RVR = 0x14, CVR = 0x18;
const ENABLE = 1, TICKINT = 2, CLKSOURCE = 4, COUNTFLAG = 1 << 16;

export class SysTick {
    constructor(chip, cycleNs) {
        Object.assign(this, { chip, cycleNs, csr: 0, reload: 0, stopped: 0, zeroAt: 0, counted: false });
        this.alarm = chip.clock.createAlarm(() => this.#zero());
        const { ppb } = chip, read = ppb.readUint32.bind(ppb), write = ppb.writeUint32.bind(ppb);
        ppb.systickAlarm.enable = false;
        ppb.readUint32 = (offset) => (offset >= CSR && offset <= CVR ? this.#read(offset) : read(offset));
        ppb.writeUint32 = (offset, value) => (offset >= CSR && offset <= CVR ? this.#write(offset, value) : write(offset, value));
    }

    get counter() {
        if (!(this.csr & ENABLE)) {
            return this.stopped;
        }
        const left = (this.zeroAt - this.chip.clock.nanos) / this.cycleNs;
        return left > this.reload ? 0 : left;
    }

    #read(offset) {
        if (offset !== CSR) {
            return offset === RVR ? this.reload : this.counter;
        }
        const flag = this.counted ? COUNTFLAG : 0;
        this.counted = false;
        return this.csr | flag;
    }

    #write(offset, value) {
        if (offset === RVR) {
            this.reload = value & 0xffffff;
            return;
        }
        const counter = offset === CVR ? 0 : this.counter;
        if (offset === CVR) {
            this.counted = false;
        } else {
            this.csr = value & (ENABLE | TICKINT | CLKSOURCE);
            if ((this.csr & (ENABLE | CLKSOURCE)) === ENABLE) {
                throw new FirmwareError("SysTick: CLKSOURCE is 0, only the processor's clock is modelled");
            }
        }
        this.stopped = counter;
        this.alarm.cancel();
        if (this.csr & ENABLE) {
            this.#count(counter > 0 ? counter : this.reload + 1);
        }
    }

    #count(cycles) {
        this.zeroAt = this.chip.clock.nanos + cycles * this.cycleNs;
        if (this.reload > 0) {
            this.alarm.schedule(cycles * this.cycleNs);
        }
    }

    #zero() {
        this.counted = true;
        if (this.csr & TICKINT) {
            this.chip.core.pendingSystick = true;
            this.chip.core.interruptsUpdated = true;
        }
        this.#count(this.reload + 1);
    }
}
