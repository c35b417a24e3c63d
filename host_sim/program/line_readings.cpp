// SPDX-License-Identifier: MIT
#include "host_sim/program/line_readings.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/program/gcode_settings.hpp"

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

bool has_letter_of(std::string_view plain, std::string_view letters) noexcept {
    return plain.find_first_of(letters) != std::string_view::npos;
}

bool has(std::string_view plain, std::string_view word) noexcept {
    return plain.find(word) != std::string_view::npos;
}

/// What is behind P, up to the next letter.
std::string_view dwell_of(std::string_view text) {
    const std::size_t at = text.find_first_of("pP");
    const std::size_t begin = at == std::string_view::npos ? at : text.find_first_not_of(" \t", at + 1);
    if (begin == std::string_view::npos) {
        return {};
    }
    const std::size_t end = text.find_first_not_of("0123456789.", begin);
    return text.substr(begin, end == std::string_view::npos ? end : end - begin);
}

std::string dwells(std::string_view text, const DialectRules& rules) {
    const std::string_view digits = dwell_of(text);
    double time = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), time);
    const bool seconds =
        rules.dwell == DwellUnit::second || (rules.dwell_point_seconds && digits.find('.') != std::string_view::npos);
    return fmt::format("waits {} s", seconds ? time : time / 1000.0);
}

std::string homes(std::string_view /*text*/, const DialectRules& rules) {
    return rules.g28_homes ? "is homing" : "goes to a stored place";
}

std::string counts_feed(std::string_view /*text*/, const DialectRules& rules) {
    return rules.feed_of_all_axes ? "has F along all of its axes" : "has F along X, Y and Z alone";
}

std::string selects(std::string_view /*text*/, const DialectRules& rules) {
    return rules.mills_only ? "is a lathe's tool and offset" : "is a number of a tool";
}

struct Kind {
    bool (*is)(std::string_view plain);
    std::string (*reading)(std::string_view text, const DialectRules& rules);
};

constexpr Kind all_kinds[] = {
    {[](std::string_view plain) { return has(plain, "g4p") || has(plain, "g04p"); }, dwells},
    {[](std::string_view plain) { return has(plain, "g28") && !has(plain, "g28."); }, homes},
    {[](std::string_view plain) { return has_letter_of(plain, "abc") && has_letter_of(plain, "xyz"); }, counts_feed},
    {has_lathe_tool, selects},
};

} // namespace

bool has_lathe_tool(std::string_view plain) noexcept {
    const std::size_t at = plain.find_first_of("mt"); // T of M204 is a printer's
    const std::size_t end = at == std::string_view::npos ? at : plain.find_first_not_of("0123456789", at + 1);
    return at != std::string_view::npos && plain[at] == 't' && std::min(end, plain.size()) - at == 5;
}

void LineReadings::add(std::string_view code, std::string_view plain, std::uint64_t number) {
    static_assert(std::size(all_kinds) == kinds);
    has_feed_ = has_feed_ || has_letter_of(plain, "f");
    inverse_time_ = (inverse_time_ || has(plain, "g93")) && !has(plain, "g94");
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const bool read_alike = (!has_feed_ || inverse_time_) && all_kinds[kind].reading == counts_feed;
        if (lines_[kind].number == 0 && !read_alike && all_kinds[kind].is(plain)) {
            lines_[kind] = {number, std::string(code.substr(0, code.find_last_not_of(" \t\r") + 1))};
        }
    }
}

std::string LineReadings::differences(Dialect taken, std::span<const Dialect> others) const {
    std::string out;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const Line& line = lines_[kind];
        if (line.number == 0) {
            continue;
        }
        const std::string here = all_kinds[kind].reading(line.text, rules_of(taken));
        std::string there;
        for (const Dialect other : others) {
            if (const std::string reading = all_kinds[kind].reading(line.text, rules_of(other)); reading != here) {
                there += fmt::format(", in {} it {}", dialect_name(other), reading);
            }
        }
        if (!there.empty()) {
            out += fmt::format("{}{} on line {} {}{}", out.empty() ? "" : "; ", in_quotes(line.text), line.number, here,
                               there);
        }
    }
    return out;
}

} // namespace splinefeed::host
