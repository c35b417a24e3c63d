// SPDX-License-Identifier: MIT
#include "host_sim/base/nearest_name.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace splinefeed::host {

namespace {

constexpr std::size_t longest_name = 64; // beyond, nobody has mistyped anything

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Edit distance with swaps of neighbours (optimal string alignment).
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::vector<std::size_t> next(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (same ? 0U : 1U)});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
                next[j] = std::min(next[j], before[j - 2] + 1);
            }
        }
        std::swap(before, row);
        std::swap(row, next);
    }
    return row[b.size()];
}

} // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
    std::string_view best;
    if (name.empty() || name.size() > longest_name) {
        return best;
    }
    // One or two letters are near to everything: nothing but the case may differ.
    std::size_t fewest = name.size() < 3 ? 1 : std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        const std::size_t count = edits(name, candidate);
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
