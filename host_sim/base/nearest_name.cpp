// SPDX-License-Identifier: MIT
#include "host_sim/base/nearest_name.hpp"

#include "splinefeed/hal/base/edit_distance.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace splinefeed::host {

namespace {

constexpr std::size_t longest_name = 64; // beyond, nobody has mistyped anything
constexpr std::size_t most_listed = 12;  // names that a sentence can hold

/// A word of names here, and what people from other programs call it.
struct Meaning {
    std::string_view here;
    std::string_view words;
};

constexpr std::array meanings{
    Meaning{"velocity", "speed seek rapid vmax vel rate"},
    Meaning{"acceleration", "amax accel"},
    Meaning{"braking", "deceleration decel"},
    Meaning{"travel", "limits limit range stroke"},
    Meaning{"steps", "scale pulses counts"},
    Meaning{"feed", "feedrate"},
    Meaning{"invert", "reverse reversed"},
    Meaning{"kind", "type"},
    Meaning{"name", "letter"},
    Meaning{"drive", "port address"},
    Meaning{"unit", "slave id"},
    Meaning{"baud", "baudrate"},
    Meaning{"stop", "bits"},
    Meaning{"hold", "stop pause"},
    Meaning{"resume", "start continue"},
    Meaning{"abort", "cancel"},
    Meaning{"override", "feed"},
    Meaning{"run", "simulate execute"},
    Meaning{"trace", "output"},
    Meaning{"machine", "config"},
    Meaning{"check", "verify test"},
};

/// Words that many names have: units, and whether a value is the largest.
constexpr std::array<std::string_view, 11> common{"max", "min", "mm", "s", "s2", "s3", "us", "ms", "per", "of", "axis"};

std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words(1);
    for (const char c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (letter) {
            words.back() += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    const auto dull = [](const std::string& word) {
        return word.empty() || std::ranges::find(common, word) != common.end();
    };
    std::erase_if(words, dull);
    return words;
}

bool means(std::string_view word, std::string_view here) {
    constexpr std::size_t shortest_part = 3; // "acc" of "acceleration"
    return word == here || (word.size() >= shortest_part && here.substr(0, word.size()) == word) ||
           std::ranges::any_of(meanings, [&](const Meaning& of) {
               return of.here == here && std::ranges::count(words_of(of.words), word) > 0;
           });
}

/// The known name that has all words of the name, or words that mean the same, and the fewest others.
std::string_view nearest_meaning(std::string_view name, std::span<const std::string_view> known) {
    const std::vector<std::string> words = words_of(name);
    std::string_view best;
    std::size_t fewest = longest_name;
    for (const std::string_view candidate : known) {
        const std::vector<std::string> here = words_of(candidate);
        const bool has_all = !words.empty() && std::ranges::all_of(words, [&](const std::string& word) {
            return std::ranges::any_of(here, [&](const std::string& h) { return means(word, h); });
        });
        if (has_all && here.size() <= fewest) {
            best = here.size() < fewest ? candidate : std::string_view{}; // of two as good ones neither
            fewest = here.size();
        }
    }
    return best;
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
        const std::size_t count = hal::edit_distance(name, candidate);
        if (count < fewest && count < std::min(name.size(), candidate.size())) {
            fewest = count;
            best = candidate;
        }
    }
    return best;
}

std::string_view meant_name(std::string_view name, std::span<const std::string_view> known) {
    const std::string_view near = nearest_name(name, known);
    return near.empty() ? nearest_meaning(name, known) : near;
}

std::string listed(std::span<const std::string_view> names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string suggestion(std::string_view name, std::span<const std::string_view> known, std::string_view page) {
    if (const std::string_view best = meant_name(name, known); !best.empty()) {
        return fmt::format("; did you mean '{}'?", best);
    }
    return known.size() > most_listed && !page.empty() ? fmt::format("; {} lists what is known", page)
                                                       : fmt::format("; known are {}", listed(known));
}

} // namespace splinefeed::host
