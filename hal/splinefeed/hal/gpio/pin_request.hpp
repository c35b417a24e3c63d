// SPDX-License-Identifier: MIT
// PinName, OutputRequest, InputRequest, InputEvent: requests for lines of a GPIO chip, and events of inputs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace splinefeed::hal::gpio {

/// Largest number of lines of one request, OutputPins or InputPins; masks have as many bits.
inline constexpr unsigned most_lines = 64;

/// The message is one sentence: the chip, the line, what is wrong and how to correct it.
struct GpioError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Identifies a line by name, by offset, or by both, which must then agree.
struct PinName {
    std::string name{}; ///< name in the kernel; empty: identified by offset
    std::optional<unsigned> offset{};

    friend bool operator==(const PinName&, const PinName&) = default;
};

enum class Bias : std::uint8_t { as_is, disabled, pull_up, pull_down };

/// Levels are electrical: true is high. This layer inverts nothing.
struct OutputRequest {
    PinName line{};
    bool safe_level = false; ///< level at the request, after a crash and at the end
};

/// Bit i: the safe level of request i.
[[nodiscard]] constexpr std::uint64_t safe_levels_of(std::span<const OutputRequest> requests) noexcept {
    std::uint64_t levels = 0;
    for (std::size_t i = 0; i < requests.size() && i < most_lines; ++i) {
        levels |= std::uint64_t{requests[i].safe_level ? 1U : 0U} << i;
    }
    return levels;
}

struct InputRequest {
    PinName line{};
    Bias bias = Bias::as_is; ///< ignored by chips without bias settings
};

/// An edge of an input, with the kernel's time stamp.
struct InputEvent {
    std::uint8_t line = 0;     ///< index in the requests
    bool rising = false;       ///< to high
    std::uint64_t time_ns = 0; ///< CLOCK_MONOTONIC
    /// Edges of this line that the kernel dropped since the previous event. Always 0 with libgpiod 1.x, which does not
    /// report them.
    std::uint32_t missed = 0;
};

} // namespace splinefeed::hal::gpio
