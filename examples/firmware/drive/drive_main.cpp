// SPDX-License-Identifier: MIT
// The board as a drive: a Modbus RTU slave with the map splinefeed-pvt. docs/how-to/make_a_modbus_drive.md
//
//   host ── UART ── RtuWire ── PvtRegisters ── PvtDrive ── slots ── StepGenerator ── pins
//                   (tick)     └──── main loop ───┘                  (tick)
#include "drive/pvt_drive.hpp"
#include "drive/rtu_wire.hpp"
#include "startup.hpp"

#include "splinefeed/base/slot.hpp"

namespace firmware {

namespace {

constexpr RtuTiming timing{.silence = 1750 / board::tick_us + 1, .patience = 20'000 / board::tick_us};

// Built in main: their bytes start as zeros, and no constructor runs before main.
splinefeed::Slot<std::array<MotionPart, slots_ahead + 1>> parts;
splinefeed::Slot<std::array<PvtSegment, drive_ring>> ring;
splinefeed::Slot<DriveSteps> steps;
splinefeed::Slot<RtuWire> line;
splinefeed::Slot<PvtDrive> drive;
splinefeed::Slot<PvtRegisters> registers;
std::atomic<bool> limit; // pressed, at the last tick

} // namespace

void on_tick() {
    Inputs inputs = begin_tick();
    limit.store(inputs.limit, std::memory_order_relaxed);
    inputs.limit = false; // the drive stops its axes itself
    board::run_ticks([&inputs](auto&& write) { steps->tick(inputs, write); });
    // Not the functions themselves: those would be called by their addresses.
    line->poll([] { return board::read_byte(); }, [](std::uint8_t byte) { return board::write_byte(byte); });
}

} // namespace firmware

int main() {
    using namespace firmware;
    board::start();
    DriveSteps& generator = steps.build(parts.build(), no_lookahead);
    RtuWire& wire = line.build(drive_unit, timing);
    PvtDrive& motion = drive.build(generator, ring.build());
    PvtRegisters& map = registers.build(motion, boot_number());
    board::start_timer();
    board::start_watchdog();
    WatchdogFeeder feeder;
    bool powered = false;
    for (;;) {
        feeder.look(generator.ticks());
        motion.poll(limit.load(std::memory_order_relaxed));
        if (motion.powered() != powered) {
            powered = !powered;
            powered ? energise_drives() : board::enable_drives(false);
        }
        if (wire.asked()) {
            wire.answer(answer_request(wire.request(), drive_unit, map, wire.reply()));
        }
    }
}
