// SPDX-License-Identifier: MIT
// Tables that have a sentence for each value of an enumeration of errors, in its order.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstddef>

#define SPLINEFEED_QUOTED(value) #value
#define SPLINEFEED_TEXT_OF(value) SPLINEFEED_QUOTED(value)

namespace splinefeed {

/// What axes_out_of_range means in this build.
inline constexpr const char* axes_sentence = "a machine has 1 to " SPLINEFEED_TEXT_OF(SPLINEFEED_MAX_AXES) " axes";

/// A row of such a table.
template <class E>
struct Sentence {
    E error;
    const char* text;
};

/// Whether the table has each value from 0 to `last`, for a static_assert beside it.
template <class E, std::size_t n>
[[nodiscard]] consteval bool has_all(const Sentence<E> (&table)[n], E last) noexcept {
    for (std::size_t row = 0; row < n; ++row) {
        if (table[row].error != static_cast<E>(row)) {
            return false;
        }
    }
    return table[n - 1].error == last;
}

/// The sentence; of a value that is none, "unknown error".
template <class E, std::size_t n>
[[nodiscard]] constexpr const char* sentence_of(const Sentence<E> (&table)[n], E error) noexcept {
    const auto row = static_cast<std::size_t>(error);
    return row < n ? table[row].text : "unknown error";
}

} // namespace splinefeed
