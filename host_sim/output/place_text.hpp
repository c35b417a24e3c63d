// SPDX-License-Identifier: MIT
// PlaceText: the positions of the axes, as they are stated at the end of the message that ends a run.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// "; the machine stands at x=1.0000 y=2.0000 mm"
class PlaceText {
public:
    /// @param before  text before the numbers
    explicit PlaceText(std::string_view before = "; the machine stands at", int decimals = 4)
        : text_(before), decimals_(decimals) {}

    /// @param online  true: this is the present position; false: the last reported position of its drive
    void add(std::string_view axis, double mm, bool online = true);
    [[nodiscard]] std::string text() const { return text_ + " mm"; }

private:
    std::string text_;
    int decimals_;
};

/// ", on line 12"; empty where the line is 0, unknown.
[[nodiscard]] std::string on_line(std::uint64_t line);

} // namespace splinefeed::host
