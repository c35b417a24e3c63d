// SPDX-License-Identifier: MIT
// Console: lines from the host to the motion, and what the host is told. docs/reference/firmware_protocol.md
#pragma once

#include "serial.hpp"
#include "waypoints/line_parser.hpp"
#include "waypoints/motion.hpp"

namespace firmware {

class Console {
public:
    Console(Serial& serial, Motion& motion) noexcept : serial_(serial), motion_(motion) {}

    /// Says which board this is, and why it started.
    void greet() noexcept;
    /// A round of the main loop: requests, the next line, events.
    void poll() noexcept;
    /// Whether the host wants to see what the watchdog does.
    [[nodiscard]] bool stalled() const noexcept { return stalled_; }

private:
    static constexpr std::size_t longest_line = 100;

    void obey_requests() noexcept;
    void read_lines() noexcept;
    void abort() noexcept;
    void execute(const Command& command) noexcept;
    void give_waypoint() noexcept;
    void answer(splinefeed::Status status) noexcept;
    void refuse(const char* reason) noexcept;
    void refuse_waypoint(const char* reason) noexcept;
    void report() noexcept;
    void tell(const char* event) noexcept;
    void report_status() noexcept;
    void report_memory() noexcept;
    void say(const char* text) noexcept { serial_.write(text); }
    void say_number(std::uint32_t value, unsigned digits = 1) noexcept;
    void say_position() noexcept;

    Serial& serial_;
    Motion& motion_;
    std::array<char, longest_line> line_{};
    std::size_t length_ = 0;
    splinefeed::Waypoint<Real> waypoint_{};
    bool too_long_ = false; // the line that is being read
    bool waiting_ = false;  // waypoint_ was read, and there was no room for it yet
    bool broken_ = false;   // a waypoint was refused: the rest of its program would be another path
    bool stalled_ = false;
};

} // namespace firmware
