// SPDX-License-Identifier: MIT
#include "host_sim/output/place_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace splinefeed::host {

void PlaceText::add(std::string_view axis, std::optional<double> mm, bool online) {
    if (!mm) {
        unknown_.emplace_back(axis);
        return;
    }
    ++known_;
    text_ += fmt::format(" {}={:.{}f}{}", axis, *mm, decimals_, online ? "" : " (when it was last heard)");
}

std::string PlaceText::text() const {
    std::string known = known_ > 0 ? text_ + " mm" : std::string();
    if (unknown_.empty()) {
        return known;
    }
    const bool one = unknown_.size() == 1;
    return fmt::format("{}; where {} {} is not known (find {} again)", known,
                       known_ > 0 ? fmt::format("{}", fmt::join(unknown_, ", ")) : "the machine",
                       known_ > 0 && !one ? "stand" : "stands",
                       known_ == 0 ? "the references"
                       : one       ? "its reference"
                                   : "their references");
}

std::string on_line(std::uint64_t line) {
    return line > 0 ? fmt::format(", on line {}", line) : std::string();
}

} // namespace splinefeed::host
