// SPDX-License-Identifier: MIT
// PlaceText: where the axes of a machine stand, as the sentence that ends a run says it.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// "; the machine stands at x=1.0000 y=2.0000 mm"
class PlaceText {
public:
    /// @param before  what is said of the numbers
    explicit PlaceText(std::string_view before = "; the machine stands at", int decimals = 4)
        : text_(before), decimals_(decimals) {}

    /// @param online  that is where it is now; else where it was when its drive was last online
    void add(std::string_view axis, double mm, bool online = true);
    [[nodiscard]] std::string text() const { return text_ + " mm"; }

private:
    std::string text_;
    int decimals_;
};

} // namespace splinefeed::host
