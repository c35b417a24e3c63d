// SPDX-License-Identifier: MIT
// number_text: reads a decimal number. The whole text must be a number: +1.5, -12, .5, 3e-2; never nan, inf or
// hexadecimal.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace splinefeed::host {

enum class NumberText { number, not_a_number, not_finite, out_of_range };

/// Reads the whole text into `out`, correctly rounded, in every locale.
[[nodiscard]] inline NumberText read_number(std::string_view text, double& out) noexcept {
    const char* first = text.data();
    const char* const last = text.data() + text.size();
    if (first != last && *first == '+') {
        ++first;
        if (first != last && (*first == '+' || *first == '-')) {
            return NumberText::not_a_number;
        }
    }
    const auto [end, error] = std::from_chars(first, last, out);
    if (end != last || error == std::errc::invalid_argument) {
        return NumberText::not_a_number;
    }
    if (error != std::errc{}) {
        return NumberText::out_of_range;
    }
    return std::isfinite(out) ? NumberText::number : NumberText::not_finite;
}

/// The whole text as an integer from `low` to `high`: digits with an optional minus sign. Nothing if it is not one.
template <class Whole>
[[nodiscard]] std::optional<Whole> read_whole(std::string_view text, Whole low, Whole high) noexcept {
    Whole number{};
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    const bool fits = error == std::errc{} && end == last && number >= low && number <= high;
    return fits ? std::optional(number) : std::nullopt;
}

/// The end of a message about a text that is not a number; the text comes before it.
[[nodiscard]] constexpr const char* why_no_number(NumberText result) noexcept {
    switch (result) {
    case NumberText::not_finite: return "is not finite; every number must be";
    case NumberText::out_of_range: return "is out of the range of a number";
    case NumberText::number:
    case NumberText::not_a_number: break;
    }
    return "is not a number; write it like -12.5 or 3e-2";
}

} // namespace splinefeed::host
