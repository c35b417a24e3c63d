// SPDX-License-Identifier: MIT
// What the firmware needs from a board. One file gives it: boards/NAME.hpp, which the build names as FIRMWARE_BOARD.
//
//   namespace board {
//   constexpr const char* name;
//   using Real = splinefeed::Fixed;            // or float
//   constexpr unsigned tick_us;                // of the motion
//   constexpr unsigned ticks_an_interrupt;     // made in one; a byte on the line lasts longer, or has a FIFO
//   constexpr unsigned pulse_us;               // how long a pulse lasts
//   constexpr unsigned segment_us;             // of a feed segment: one part of motion in the ring
//   constexpr unsigned steps_per_s;            // of the fastest axis; Lines::counts_in_ticks
//   constexpr std::size_t window;              // cells of look-ahead, 10 or more
//   constexpr bool curves_through_points;      // whether it has RAM for G5.5; of boards that senders operate
//   constexpr std::size_t parameters;          // of those, too: #1 to this one, and expressions; 0: it has neither
//   constexpr std::size_t parts;               // of motion in the ring: longer than any next()
//   constexpr unsigned interrupts;             // vectors after the 16 of the processor
//   constexpr int timer_interrupt;             // the tick's, one of them; -1: SysTick
//   void start();                              // clock, pins, UART; the drives are off
//   void start_timer();                        // from here on the tick's vector is called
//   void start_watchdog();                     // a reset half a second after the last feeding
//   void acknowledge_tick();
//   void feed_watchdog();
//   bool watchdog_bit();                       // this start is the watchdog's work; clears what says so
//   using Lines;                               // of StepGenerator, for three axes
//   Lines lines();
//   void run_ticks(Tick tick);                 // tick(write) for each of an interrupt, write as Lines call it
//   void enable_drives(bool on);
//   firmware::Inputs read_inputs();            // {emergency stop, limit switch}; true: stop
//   std::uint32_t line_session();              // another number for each sender that opens the line
//   int read_byte();                           // a byte, Serial::nothing, or Serial::lost: overrun, framing, break
//   bool write_byte(std::uint8_t byte);        // false: the UART has no room now
//   }
#pragma once

#include "serial.hpp"
#include "step_generator.hpp"

#include FIRMWARE_BOARD

namespace firmware {

/// Gives the drives power, unless the emergency stop is pressed: then they never have it, not for a tick either.
inline void energise_drives() {
    board::enable_drives(!board::read_inputs().estop);
}

/// What the interrupt does first. The tick that reads the emergency stop takes the power of the drives.
inline Inputs begin_tick() {
    board::acknowledge_tick();
    const Inputs inputs = board::read_inputs();
    if (inputs.estop) {
        board::enable_drives(false);
    }
    return inputs;
}

/// Feeds the watchdog as long as the timer runs, and so does the main loop that calls it.
class WatchdogFeeder {
public:
    void look(std::uint32_t ticks) noexcept {
        if (ticks != ticks_) {
            ticks_ = ticks;
            board::feed_watchdog();
        }
    }

private:
    std::uint32_t ticks_ = 0;
};

} // namespace firmware
