// SPDX-License-Identifier: MIT
#include "host_sim/output/place_text.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

void PlaceText::add(std::string_view axis, double mm, bool online) {
    text_ += fmt::format(" {}={:.{}f}{}", axis, mm, decimals_, online ? "" : " (when it was last heard)");
}

} // namespace splinefeed::host
