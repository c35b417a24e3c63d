// SPDX-License-Identifier: MIT
#include "rp2040/usb_serial.hpp"

#include "rp2040/usb_descriptors.hpp"

namespace rp2040 {

void UsbSerial::start() noexcept {
    port_.write(RESETS_SET, reset_usbctrl);
    port_.write(RESETS_CLR, reset_usbctrl);
    while ((port_.read(RESET_DONE) & reset_usbctrl) == 0) {
    }
    for (std::uintptr_t at = DPSRAM; at < DPSRAM + 0x100; at += 4) {
        port_.write(at, 0); // no reset does that
    }
    port_.write(USB_MUXING, 9); // SOFTCON, TO_PHY
    port_.write(USB_PWR, 12);   // VBUS_DETECT, by its override: the Pico has VBUS on another pin
    port_.write(MAIN_CTRL, 1);  // CONTROLLER_EN
    port_.write(SIE_CTRL, sie_ep0_int_1buf | sie_pullup_en);
}

void UsbSerial::poll() noexcept {
    // In this order: what was over before an event is in BUFF_STATUS.
    const std::uint32_t status = port_.read(SIE_STATUS) & (sie_bus_reset | sie_setup_rec | sie_suspended);
    const std::uint32_t frame = port_.read(SOF_RD);
    const std::uint32_t buffers = port_.read(BUFF_STATUS);
    if ((status | buffers) != 0) {
        port_.write(SIE_STATUS, status);
        port_.write(BUFF_STATUS, buffers);
    }
    const bool same_frame = frame == frame_;
    frame_ = frame;
    polls_of_frame_ = same_frame ? polls_of_frame_ + 1 : 0;
    suspended_ = (status & sie_suspended) != 0 || (suspended_ && same_frame);
    if ((status & sie_bus_reset) != 0) { // it lasts 10 ms: a SETUP beside it is older
        control_in_.restart(true);
        control_out_.restart(true);
        configure(false);
        port_.write(ADDR_ENDP, 0);
        suspended_ = false;
    } else if ((status | buffers) != 0) {
        in_.look(buffers, (status & sie_setup_rec) != 0 || (buffers & 1) != 0);
        if (out_.look(buffers) && out_.size() == 0) {
            out_.receive();
        }
        go_on(buffers);
        if ((status & sie_setup_rec) != 0) {
            begin_request();
        }
    }
    // E15: near the end of a frame some hubs break packets off, and the controller hangs. The fifth poll is there.
    if (sender_ && !suspended_ && polls_of_frame_ != 4 && in_.is_free() && (count_ > 0 || was_full_)) {
        in_.send(std::span(next_).first(count_));
        was_full_ = count_ == next_.size();
        count_ = 0;
    }
    open_.store(sender_ && !suspended_, std::memory_order_relaxed);
}

void UsbSerial::go_on(std::uint32_t buffers) noexcept {
    const bool sent = control_in_.look(buffers);
    if (control_out_.look(buffers)) {
        control_in_.restart(true); // the host may end an answer early
        if (stage_ == Stage::data) {
            for (std::uint8_t& byte : line_coding_) {
                byte = control_out_.size() > 0 ? control_out_.take() : byte;
            }
            control_in_.send({});
        }
        stage_ = Stage::status;
    } else if (sent && stage_ == Stage::answer) {
        send_answer();
    } else if (sent && stage_ == Stage::address) {
        port_.write(ADDR_ENDP, address_);
    }
}

void UsbSerial::begin_request() noexcept {
    const std::uint32_t first = port_.read(DPSRAM);
    const std::uint32_t second = port_.read(DPSRAM + 4);
    const std::uint32_t length = second >> 16;
    control_in_.restart(true); // whatever they were waiting for
    control_out_.restart(true);
    stage_ = answer(first & 0xffff, first >> 16, second & 0xffff, length);
    if (stage_ == Stage::refused) {
        port_.write(EP_STALL_ARM, 3); // until the next SETUP
        control_in_.halt();
        control_out_.halt();
    } else if (stage_ == Stage::data) {
        control_out_.receive();
    } else if (stage_ == Stage::answer && length > 0) {
        is_short_ = to_answer_.size() < length;
        to_answer_ = to_answer_.first(is_short_ ? to_answer_.size() : length);
        control_out_.receive(); // its status
        send_answer();
    } else {
        control_in_.send({});
    }
}

/// The next packet. A shorter one ends the answer; so does what the host asked for, which it has counted.
void UsbSerial::send_answer() noexcept {
    const std::size_t size = to_answer_.size() < UsbPipe::packet ? to_answer_.size() : UsbPipe::packet;
    control_in_.send(to_answer_.first(size));
    to_answer_ = to_answer_.subspan(size);
    stage_ = size == UsbPipe::packet && (is_short_ || !to_answer_.empty()) ? Stage::answer : Stage::status;
}

/// @param request  bmRequestType, and above it bRequest: USB 2.0, 9.4; PSTN 1.2, 6.3  @return what comes next
UsbSerial::Stage UsbSerial::answer(std::uint32_t request, std::uint32_t value, std::uint32_t index,
                                   std::uint32_t length) noexcept {
    const bool is_configured = configuration_ != 0;
    const bool is_interface = is_configured && index < 2;
    const bool is_port = is_configured && index == 0;
    UsbPipe* pipe = nullptr;
    for (UsbPipe& each : pipes_) {
        pipe = is_configured && each.address() == index ? &each : pipe;
    }
    const bool halts = pipe != nullptr && value == 0; // ENDPOINT_HALT
    to_answer_ = reply_ = {};
    if ((request & 0x80) == 0 && length > 0 && request != 0x2021) { // data comes with one only
        return Stage::refused;
    }
    switch (request) {
    case 0x0080: return Stage::answer; // GET_STATUS of the device: powered by the bus, wakes nobody
    case 0x0081: return is_interface ? Stage::answer : Stage::refused; // of an interface
    case 0x0082:                                                       // of an endpoint; 0 is never halted
        reply_[0] = pipe != nullptr && pipe->is_halted() ? 1 : 0;
        return pipe != nullptr || (index & 0xff7f) == 0 ? Stage::answer : Stage::refused;
    case 0x0102: // CLEAR_FEATURE
    case 0x0302: // SET_FEATURE
        if (halts) {
            request == 0x0302 ? pipe->halt() : pipe->clear_halt();
        }
        return halts ? Stage::status : Stage::refused;
    case 0x0500: // SET_ADDRESS
        address_ = value;
        return value < 0x80 ? Stage::address : Stage::refused;
    case 0x0680: // GET_DESCRIPTOR
        to_answer_ = usb_descriptor(value);
        return !to_answer_.empty() ? Stage::answer : Stage::refused;
    case 0x0880: to_answer_ = {&configuration_, 1}; return Stage::answer; // GET_CONFIGURATION
    case 0x0900:                                                          // SET_CONFIGURATION
        if (value < 2) {
            configure(value == 1);
        }
        return value < 2 ? Stage::status : Stage::refused;
    case 0x0a81: to_answer_ = {reply_.data(), 1}; return is_interface ? Stage::answer : Stage::refused; // GET_INTERFACE
    case 0x2021: return is_port && length == line_coding_.size() ? Stage::data : Stage::refused; // SET_LINE_CODING
    case 0x21a1: to_answer_ = line_coding_; return is_port ? Stage::answer : Stage::refused;     // GET_LINE_CODING
    case 0x2220: // as rp2040js asks, of the device
    case 0x2221: // SET_CONTROL_LINE_STATE
        if (is_port) {
            set_sender((value & 1) != 0); // DTR
        }
        return is_port ? Stage::status : Stage::refused;
    default: return Stage::refused;
    }
}

void UsbSerial::configure(bool on) noexcept {
    set_sender(false);
    configuration_ = on ? 1 : 0;
    for (UsbPipe& pipe : pipes_) {
        pipe.enable(on);
    }
    if (on) {
        out_.receive();
    }
}

void UsbSerial::set_sender(bool here) noexcept {
    if (here && !sender_) { // the host does not know yet: what is here is older
        sessions_.store(sessions() + 1, std::memory_order_relaxed);
        count_ = 0;
        was_full_ = false;
        if (out_.size() > 0) {
            out_.receive();
        }
    } else if (!here) {
        in_.revoke();
    }
    sender_ = here;
}

} // namespace rp2040
