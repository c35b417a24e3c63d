// SPDX-License-Identifier: MIT
// LineMap: which line of which chip does what on a machine; a map file in memory (docs/reference/gpio.md).
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/hal/gpio/line_request.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// A line among those of LineMap::chips: an output is bit `bit` of the chip's OutputLines, an input of its InputLines.
struct LineBit {
    std::uint8_t chip = 0;
    std::uint8_t bit = 0;

    [[nodiscard]] constexpr std::uint64_t mask() const noexcept { return std::uint64_t{1} << bit; }
    friend bool operator==(const LineBit&, const LineBit&) = default;
};

/// All lines that are used of one chip: one OutputLines and one InputLines, where they are not empty.
struct ChipLines {
    std::string chip; ///< "/dev/gpiochip0"
    std::vector<OutputRequest> outputs;
    std::vector<InputRequest> inputs;
};

struct MotorLines {
    LineBit step;
    LineBit direction;
};

/// Polarity is not in here: the machine file states it, and the safe levels of ChipLines::outputs have it.
struct AxisLines {
    unsigned motors = 1; ///< 1 or 2, as the machine file says
    std::array<MotorLines, 2> motor{};
};

/// Switches all drives on.
struct EnableLine {
    LineBit line;
    bool active_level = true;      ///< drives are on; its safe level is the other one
    std::uint32_t settle_ms = 500; ///< from there to the first step, 0 to 60000
};

/// Holds an axis that would fall while the drives are off.
struct BrakeLine {
    LineBit line;
    bool released_level = true;     ///< the axis is free; its safe level is the other one
    std::uint32_t release_ms = 100; ///< from releasing it to the first step, 0 to 5000
    std::uint32_t engage_ms = 100;  ///< from engaging it to switching the drives off, 0 to 5000
};

enum class InputRole : std::uint8_t { e_stop, limit, home, drive_fault, probe };

struct MappedInput {
    InputRole role = InputRole::e_stop;
    int axis = -1; ///< of limit and home: the machine's axis; else -1
    LineBit line;
    bool active_level = true;      ///< at which it acts
    std::uint32_t debounce_us = 0; ///< 0 to 100000
};

/// How an axis finds its switch. Its home input is in LineMap::inputs.
struct HomeSearch {
    bool towards_high = false;
    double seek_mm_s = 0.0;
    double latch_mm_s = 0.0; ///< at most seek_mm_s
    double pull_off_mm = 0.0;
    double position_mm = 0.0; ///< of the switch's edge
};

/// Of the thread that makes edges.
struct ThreadSettings {
    int priority = 80;                     ///< SCHED_FIFO, 1 to 98
    std::optional<unsigned> cpu{};         ///< the one it is bound to
    std::uint32_t spin_us = 30;            ///< of each wait spent spinning, 0 to 1000
    std::uint32_t tolerated_late_us = 100; ///< an edge that comes later stretches time, 0 to 10000
    std::uint32_t stall_ms = 40;           ///< while axes move, one that comes later is a fault, 1 to 10000
};

struct LineMap {
    std::string consumer = "splinefeed";
    std::vector<ChipLines> chips;
    std::array<AxisLines, max_axes> axis{}; ///< in the order of the machine file
    std::optional<EnableLine> enable;
    std::optional<BrakeLine> brake;
    std::vector<MappedInput> inputs; ///< in the order of the map file
    std::array<std::optional<HomeSearch>, max_axes> home{};
    ThreadSettings thread;
};

} // namespace splinefeed::hal::gpio
