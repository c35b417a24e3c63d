// SPDX-License-Identifier: MIT
// LineName, OutputRequest, InputRequest, InputEvent: lines of a GPIO chip as they are asked for, and what they tell.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace splinefeed::hal::gpio {

/// The most lines of one request, and with that of an OutputLines or InputLines: bits of a mask.
inline constexpr unsigned most_lines = 64;

/// One sentence: the chip, the line, what is wrong and what would be right.
struct GpioError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A line of a chip: by its name, by its offset, or by both, which are then checked against each other.
struct LineName {
    std::string name{}; ///< as the kernel has it; empty: the offset counts
    std::optional<unsigned> offset{};

    friend bool operator==(const LineName&, const LineName&) = default;
};

enum class Bias : std::uint8_t { as_is, disabled, pull_up, pull_down };

/// Levels are those of the wire, true is high; nothing is inverted here.
struct OutputRequest {
    LineName line{};
    bool safe_level = false; ///< from the request on, and on every way out
};

struct InputRequest {
    LineName line{};
    Bias bias = Bias::as_is; ///< a chip that has none ignores it
};

/// An edge of an input, with the kernel's time stamp.
struct InputEvent {
    std::uint8_t line = 0;     ///< index in the requests
    bool rising = false;       ///< to high
    std::uint64_t time_ns = 0; ///< CLOCK_MONOTONIC
    /// Edges of this line that the kernel dropped since the event before. libgpiod 1.x does not tell: 0.
    std::uint32_t missed = 0;
};

} // namespace splinefeed::hal::gpio
