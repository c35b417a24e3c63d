// SPDX-License-Identifier: MIT
#include "host_sim/output/place_text.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

void PlaceText::add(std::string_view axis, double mm, bool online) {
    text_ += fmt::format(" {}={:.{}f}{}", axis, mm, decimals_, online ? "" : " (when it was last heard)");
}

std::string on_line(std::uint64_t line) {
    return line > 0 ? fmt::format(", on line {}", line) : std::string();
}

} // namespace splinefeed::host
