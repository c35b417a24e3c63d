// SPDX-License-Identifier: MIT
// PinMap: assigns GPIO lines to the functions of a machine; the contents of a map file (docs/reference/gpio.md).
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/hal/gpio/pin_request.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// Refers to a line of PinMap::chips: bit `bit` of the chip's OutputPins or InputPins.
struct PinBit {
    std::uint8_t chip = 0;
    std::uint8_t bit = 0;

    [[nodiscard]] constexpr std::uint64_t mask() const noexcept { return std::uint64_t{1} << bit; }
    friend bool operator==(const PinBit&, const PinBit&) = default;
};

/// The lines used on one chip: one OutputPins and one InputPins object, unless empty.
struct ChipPins {
    std::string chip; ///< "/dev/gpiochip0", or "label=pinctrl-bcm2711"
    std::vector<OutputRequest> outputs;
    std::vector<InputRequest> inputs;
};

struct MotorPins {
    PinBit step;
    PinBit direction;
};

/// Does not include the polarity: the machine file states it, and the safe levels of ChipPins::outputs include it.
struct AxisPins {
    unsigned motors = 1; ///< 1 or 2, from the machine file
    std::array<MotorPins, 2> motor{};
};

/// Enable line of all drives.
struct EnablePin {
    PinBit line;
    bool active_level = true;      ///< level that enables the drives; the safe level is the opposite
    std::uint32_t settle_ms = 500; ///< from enabling to the first step, 0 to 60000
};

/// Brake that holds an axis while the drives are off.
struct BrakePin {
    PinBit line;
    bool released_level = true;     ///< level that releases the brake; the safe level is the opposite
    std::uint32_t release_ms = 100; ///< from releasing it to the first step, 0 to 5000
    std::uint32_t engage_ms = 100;  ///< from engaging it to switching the drives off, 0 to 5000
};

enum class InputRole : std::uint8_t { e_stop, limit, home, drive_fault, probe };

struct MappedInput {
    InputRole role = InputRole::e_stop;
    int axis = -1; ///< limit and home: axis of the machine; else -1
    PinBit line;
    bool active_level = true;      ///< level of the active state
    std::uint32_t debounce_us = 0; ///< 0 to 100000
};

/// How an axis finds its home switch. The home input is in PinMap::inputs.
struct HomeSearch {
    bool towards_high = false;
    double seek_mm_s = 0.0;
    double latch_mm_s = 0.0; ///< at most seek_mm_s
    double pull_off_mm = 0.0;
    double position_mm = 0.0; ///< position of the switch's edge
};

/// Settings of the thread that writes edges.
struct ThreadSettings {
    int priority = 80;                     ///< SCHED_FIFO priority, 1 to 98
    std::optional<unsigned> cpu{};         ///< processor to which it is bound
    std::uint32_t spin_us = 30;            ///< last part of each wait spent spinning, 0 to 1000
    std::uint32_t tolerated_late_us = 100; ///< an edge that is later than this delays the whole motion, 0 to 10000
    std::uint32_t stall_ms = 40;           ///< an edge that is later than this while axes move is a fault, 1 to 10000
};

struct PinMap {
    std::string file; ///< that says so, for messages
    std::string consumer = "splinefeed";
    std::vector<ChipPins> chips;
    std::array<AxisPins, max_axes> axis{}; ///< in the order of the machine file
    std::optional<EnablePin> enable;
    std::optional<BrakePin> brake;
    std::vector<MappedInput> inputs; ///< in the order of the map file
    std::array<std::optional<HomeSearch>, max_axes> home{};
    ThreadSettings thread;
};

} // namespace splinefeed::hal::gpio
