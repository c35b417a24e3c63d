// SPDX-License-Identifier: MIT
#include "host_sim/analysis/share_table.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace splinefeed::host {

namespace {

std::string percent(double share) {
    return fmt::format("{:.1f} %", share * 100.0);
}

} // namespace

std::string share_table(const std::vector<std::string>& names, const LimitShares& shares) {
    const bool any_jerk = std::any_of(shares.axis.begin(), shares.axis.end(),
                                      [](const LimitShares::Axis& axis) { return axis.jerk.has_value(); });
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{:<22}{:>14}{:>14}{}\n", "share of the time at", "velocity", "acceleration",
                   any_jerk ? "          jerk" : "");
    for (std::size_t k = 0; k < shares.axis.size(); ++k) {
        const LimitShares::Axis& axis = shares.axis[k];
        fmt::format_to(out, "{:<22}{:>14}{:>14}", "  axis " + names[k], percent(axis.velocity),
                       percent(axis.acceleration));
        if (any_jerk) {
            fmt::format_to(out, "{:>14}", axis.jerk ? percent(*axis.jerk) : "no limit");
        }
        fmt::format_to(out, "\n");
    }
    const auto row = [&out](const char* label, double share) {
        fmt::format_to(out, "{:<22}{:>14}\n", label, percent(share));
    };
    row("  path feed", shares.feed);
    if (shares.centripetal) {
        row("  centripetal", *shares.centripetal);
    }
    if (shares.chord) {
        row("  chord error", *shares.chord);
    }
    row("  no limit", shares.none);
    return text;
}

} // namespace splinefeed::host
