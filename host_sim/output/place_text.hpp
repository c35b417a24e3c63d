// SPDX-License-Identifier: MIT
// PlaceText: the places of the axes, as they are stated at the end of the message that ends a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// "; the machine stands at x=1.0000 y=2.0000 mm; where z stands is not known (find its reference again)". It claims
/// nothing about an axis whose place is not known.
class PlaceText {
public:
    /// @param before  text before the numbers
    explicit PlaceText(std::string_view before = "; the machine stands at", int decimals = 4)
        : text_(before), decimals_(decimals) {}

    /// @param mm  nothing: the place is not known
    /// @param online  true: this is the present position; false: the last reported position of its drive
    void add(std::string_view axis, std::optional<double> mm, bool online = true);
    [[nodiscard]] std::string text() const;

private:
    std::string text_;
    int decimals_;
    int known_ = 0;
    std::vector<std::string> unknown_; // axes
};

/// ", on line 12"; empty where the line is 0, unknown.
[[nodiscard]] std::string on_line(std::uint64_t line);

} // namespace splinefeed::host
