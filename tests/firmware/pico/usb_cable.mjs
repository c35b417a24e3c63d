// SPDX-License-Identifier: MIT
// A host behind a USB cable: rp2040js's USBCDC enumerates the device; beyond it the host may stop reading, and the cable be pulled. A buffer is the device's again
// when the host has taken it, 10 us later, and nothing is received before it was sent; rp2040js gives it back at once, and sends empty packets without end.
import { USBCDC } from "./emulator.mjs";

const SIE_CTRL = 0x4c, SIE_STATUS = 0x50, PULLUP_EN = 1 << 16, SUSPENDED = 1 << 4;
const FRAME_NS = 1e6;

export class UsbCable {
    constructor() {
        Object.assign(this, { attached: false, reading: true, said: "", heard: [], connects: 0, onSaid: null });
    }

    /** At the chip, since its last reset. */
    plugInto(chip) {
        const usb = this.usb = chip.usbCtrl;
        Object.assign(this, { cdc: null, held: [], armed: 0 });
        this.frames = chip.clock.createAlarm(() => this.#frame());
        this.suspend = chip.clock.createAlarm(() => {
            usb.sieStatus |= SUSPENDED;
            usb.sieStatusUpdated();
        });
        this.given = usb.indicateBufferReady.bind(usb);
        usb.indicateBufferReady = (endpoint, out) => out && this.given(endpoint, true);
        const write = usb.writeUint32.bind(usb);
        usb.writeUint32 = (offset, value) => {
            const pulled = usb.sieCtrl & PULLUP_EN;
            write(offset, value);
            if (offset === SIE_CTRL && !pulled && usb.sieCtrl & PULLUP_EN && this.attached) {
                this.attach();
            }
            if (offset === SIE_STATUS && usb.rawWriteValue & SUSPENDED) {
                usb.sieStatus &= ~SUSPENDED;
                usb.sieStatusUpdated();
            }
        };
    }

    /** The host resets the device and enumerates it, once it pulls its line up. */
    attach() {
        const { usb } = this;
        this.attached = true;
        if (!(usb.sieCtrl & PULLUP_EN)) {
            return;
        }
        Object.assign(this, { held: [], armed: 0, cdc: new USBCDC(usb) });
        this.cdc.onDeviceConnected = () => { ++this.connects; };
        this.cdc.onSerialData = (data) => {
            const text = Buffer.from(data).toString("latin1");
            this.said += text;
            this.onSaid?.(text);
        };
        usb.onUSBEnabled = () => {};
        const taken = usb.onEndpointWrite;
        usb.onEndpointWrite = (endpoint, data) => {
            if (endpoint === this.cdc.inEndpoint && !this.reading) {
                this.held.push(() => { this.given(endpoint, false); taken(endpoint, data); });
            } else if (this.attached) {
                this.given(endpoint, false);
                taken(endpoint, data);
            }
        };
        usb.onEndpointRead = (endpoint, size) => {
            if (endpoint === this.cdc.outEndpoint) {
                this.armed = size;
                this.#sendNext();
            }
        };
        this.suspend.cancel();
        usb.resetDevice();
        this.frames.schedule(FRAME_NS);
    }

    /** It is pulled: no frame comes any more, and 3 ms later the device is told so. What it has to say stays there. */
    detach() {
        this.attached = false;
        this.frames.cancel();
        this.usb.resetAlarm.cancel();
        this.suspend.schedule(3 * FRAME_NS);
        this.usb.onEndpointWrite = this.usb.onEndpointRead = this.usb.onResetReceived = () => {};
        this.heard = [];
    }

    read(reading) {
        this.reading = reading;
        while (reading && this.held.length > 0) {
            this.held.shift()();
        }
    }

    takeSaid() {
        const { said } = this;
        this.said = "";
        return said;
    }

    send(text) {
        this.heard.push(...Buffer.from(text, "latin1"));
        this.#sendNext();
    }

    /** DTR and RTS as a program sets them that opens (3) or closes (0) the port. */
    setLines(lines) {
        this.cdc.cdcSetControlLineState(lines);
    }

    #sendNext() {
        if (this.attached && this.armed > 0 && this.heard.length > 0) {
            const data = Uint8Array.from(this.heard.splice(0, this.armed));
            this.armed = 0;
            this.usb.endpointReadDone(this.cdc.outEndpoint, data);
        }
    }

    #frame() {
        this.usb.sofFrameNumber = this.usb.sofFrameNumber + 1 & 0x7ff;
        this.frames.schedule(FRAME_NS);
    }
}
