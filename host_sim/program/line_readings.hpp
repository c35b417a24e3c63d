// SPDX-License-Identifier: MIT
// LineReadings: lines of a program that one dialect takes as another motion or time than the next.
#pragma once

#include "splinefeed/s0_program/dialects/program_settings.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Whether the line has a word like T0101: a tool and its offset on a lathe.
/// @param plain  in lower case, without spaces
[[nodiscard]] bool has_lathe_tool(std::string_view plain) noexcept;

/// Remembers the first line of each kind: a dwell, G28, a feed of linear and rotary axes, a lathe's tool.
class LineReadings {
public:
    /// @param code  a line without its comments
    /// @param plain  the same in lower case, without spaces
    void add(std::string_view code, std::string_view plain, std::uint64_t number);

    /// "'G4 P500' on line 7 waits 500 s, in fanuc 0.5 s". Empty: the others read each line as `taken` does.
    [[nodiscard]] std::string differences(Dialect taken, std::span<const Dialect> others) const;

private:
    static constexpr std::size_t kinds = 4;

    struct Line {
        std::uint64_t number = 0; // 0: there is none
        std::string text;
    };

    std::array<Line, kinds> lines_{};
    bool has_feed_ = false;
    bool inverse_time_ = false; // F is none along the path
};

} // namespace splinefeed::host
