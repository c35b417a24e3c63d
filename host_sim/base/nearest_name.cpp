// SPDX-License-Identifier: MIT
#include "host_sim/base/nearest_name.hpp"

#include "splinefeed/hal/base/edit_distance.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::size_t longest_name = 64; // beyond, nobody has mistyped anything

} // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
    std::string_view best;
    if (name.empty() || name.size() > longest_name) {
        return best;
    }
    // One or two letters are near to everything: nothing but the case may differ.
    std::size_t fewest = name.size() < 3 ? 1 : std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        const std::size_t count = hal::edit_distance(name, candidate);
        if (count < fewest && count < std::min(name.size(), candidate.size())) {
            fewest = count;
            best = candidate;
        }
    }
    return best;
}

std::string listed(std::span<const std::string_view> names) {
    std::string out;
    for (const std::string_view name : names) {
        if (!out.empty()) {
            out += ", ";
        }
        out += name;
    }
    return out;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> known) {
    const std::string_view best = nearest_name(name, known);
    return best.empty() ? fmt::format("; known are {}", listed(known)) : fmt::format("; did you mean '{}'?", best);
}

} // namespace splinefeed::host
