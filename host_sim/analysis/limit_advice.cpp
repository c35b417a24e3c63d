// SPDX-License-Identifier: MIT
#include "host_sim/analysis/limit_advice.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace splinefeed::host {

namespace {

constexpr double worth_a_word = 0.01; // of the time

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

std::string advice(const std::vector<std::string>& names, const LimitShares& shares) {
    double longest = worth_a_word;
    std::string limit;
    std::string what = "raising it";
    const auto consider = [&](double share, const std::string& name, const char* change) {
        if (share > longest) {
            longest = share;
            limit = name;
            what = change;
        }
    };
    const bool programmed = shares.programmed_feed > 0.5 * shares.feed;
    consider(shares.feed, programmed ? "The feed of the program" : "The machine's feed (max_feed_mm_s)", "raising it");
    for (std::size_t k = 0; k < shares.axis.size(); ++k) {
        const LimitShares::Axis& axis = shares.axis[k];
        consider(axis.velocity, fmt::format("The velocity limit of axis {}", names[k]), "raising it");
        consider(axis.acceleration, fmt::format("The acceleration limit of axis {}", names[k]), "raising it");
        consider(axis.jerk.value_or(0.0), fmt::format("The jerk limit of axis {}", names[k]), "raising it");
    }
    consider(shares.centripetal.value_or(0.0), "The centripetal limit", "raising centripetal_mm_s2");
    consider(shares.chord.value_or(0.0), "The chord error", "a larger chord_error_mm or a shorter sample period");
    if (limit.empty()) {
        return fmt::format("No limit binds for more than {} of the time: the moves are too short to reach one.\n",
                           percent(worth_a_word));
    }
    return fmt::format("{} binds {} of the time, longest of all: {} would help most.\n", limit, percent(longest), what);
}

} // namespace splinefeed::host
