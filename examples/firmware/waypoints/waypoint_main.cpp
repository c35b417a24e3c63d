// SPDX-License-Identifier: MIT
// Reference firmware: waypoints by a serial line, steps by a timer's interrupt. docs/how-to/port_to_a_board.md
//
//   host ── UART ── Serial ── Console ── Motion ──────── ring of parts ── StepGenerator ── pins
//                   (tick)    └──────── main loop ────┘                   (tick)
#include "startup.hpp"
#include "waypoints/console.hpp"

namespace firmware {

namespace {

// Built in main: their bytes start as zeros, and no constructor runs before main.
splinefeed::Slot<std::array<MotionPart, board::parts + 1>> parts;
splinefeed::Slot<Steps> steps;
splinefeed::Slot<Serial> serial;
splinefeed::Slot<Motion> motion;

} // namespace

void on_tick() {
    const Inputs inputs = begin_tick();
    board::run_ticks([&inputs](auto&& write) { steps->tick(inputs, write); });
    // Not the functions themselves: those would be called by their addresses.
    serial->poll([] { return board::read_byte(); }, [](std::uint8_t byte) { return board::write_byte(byte); });
}

} // namespace firmware

int main() {
    using namespace firmware;
    board::start();
    Steps& generator = steps.build(parts.build(), lookahead, board::lines());
    Serial& line = serial.build();
    Motion& planner = motion.build(generator);
    Console console(line, planner);
    board::start_timer();
    board::start_watchdog();
    console.greet();
    WatchdogFeeder feeder;
    while (!console.stalled()) {
        feeder.look(generator.ticks());
        console.poll();
        planner.plan();
    }
    for (;;) {
    }
}
