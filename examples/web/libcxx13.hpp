// SPDX-License-Identifier: MIT
// What the C++ library of Debian's emscripten (libc++ 13) lacks of C++20, read before each source. Only what the host
// tools use: numbers from text, bits of numbers, algorithms of whole ranges, and projections where one is used.
#pragma once

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace std {

template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

/// Decimal, and inf and nan, which the callers refuse by their value. Rounded as by strtod, which is right to the last
/// bit.
inline from_chars_result from_chars(const char* first, const char* last, double& out,
                                    chars_format = chars_format::general) {
    const string text(first, find_if(first, last, [](char c) { return c == 'x' || c == 'X'; })); // 0x1 is 0
    if (text.empty() || text[0] == '+' || isspace(static_cast<unsigned char>(text[0])) != 0) {
        return {first, errc::invalid_argument};
    }
    char* end = nullptr;
    errno = 0;
    const double value = strtod(text.c_str(), &end);
    if (end == text.c_str()) {
        return {first, errc::invalid_argument};
    }
    const char* const behind = first + (end - text.c_str());
    if (errno == ERANGE) {
        return {behind, errc::result_out_of_range};
    }
    out = value;
    return {behind, errc{}};
}

} // namespace std

namespace std::ranges {

// Algorithms that take what follows their range as std's do.
#define SPLINEFEED_ALGORITHM(name)                                                                                     \
    inline constexpr auto name = [](auto&& range, auto&&... rest) {                                                    \
        return std::name(std::begin(range), std::end(range), std::forward<decltype(rest)>(rest)...);                   \
    }
SPLINEFEED_ALGORITHM(all_of);
SPLINEFEED_ALGORITHM(any_of);
SPLINEFEED_ALGORITHM(none_of);
SPLINEFEED_ALGORITHM(count);
SPLINEFEED_ALGORITHM(count_if);
SPLINEFEED_ALGORITHM(fill);
SPLINEFEED_ALGORITHM(find_if);
SPLINEFEED_ALGORITHM(find_if_not);
SPLINEFEED_ALGORITHM(for_each);
SPLINEFEED_ALGORITHM(is_sorted);
SPLINEFEED_ALGORITHM(move);
SPLINEFEED_ALGORITHM(replace_if);
SPLINEFEED_ALGORITHM(stable_sort);
SPLINEFEED_ALGORITHM(transform);
#undef SPLINEFEED_ALGORITHM

struct identity {
    template <class T>
    constexpr T&& operator()(T&& value) const noexcept {
        return std::forward<T>(value);
    }
};

// {} in the place of an order is less.
struct find_algorithm {
    template <class Range, class Value, class Projection = identity>
    constexpr auto operator()(Range&& range, const Value& value, Projection of = {}) const {
        return std::find_if(std::begin(range), std::end(range),
                            [&](auto&& one) { return std::invoke(of, one) == value; });
    }
};
inline constexpr find_algorithm find;

struct sort_algorithm {
    template <class Range, class Order = less, class Projection = identity>
    constexpr void operator()(Range&& range, Order order = {}, Projection of = {}) const {
        std::sort(std::begin(range), std::end(range), [&](const auto& a, const auto& b) {
            return std::invoke(order, std::invoke(of, a), std::invoke(of, b));
        });
    }
};
inline constexpr sort_algorithm sort;

struct max_element_algorithm {
    template <class Range, class Order = less, class Projection = identity>
    constexpr auto operator()(Range&& range, Order order = {}, Projection of = {}) const {
        return std::max_element(std::begin(range), std::end(range), [&](const auto& a, const auto& b) {
            return std::invoke(order, std::invoke(of, a), std::invoke(of, b));
        });
    }
};
inline constexpr max_element_algorithm max_element;

struct lower_bound_algorithm {
    template <class Range, class Value, class Order = less, class Projection = identity>
    constexpr auto operator()(Range&& range, const Value& value, Order order = {}, Projection of = {}) const {
        return std::lower_bound(std::begin(range), std::end(range), value, [&](const auto& one, const Value& bound) {
            return std::invoke(order, std::invoke(of, one), bound);
        });
    }
};
inline constexpr lower_bound_algorithm lower_bound;

struct upper_bound_algorithm {
    template <class Range, class Value, class Order = less, class Projection = identity>
    constexpr auto operator()(Range&& range, const Value& value, Order order = {}, Projection of = {}) const {
        return std::upper_bound(std::begin(range), std::end(range), value, [&](const Value& bound, const auto& one) {
            return std::invoke(order, bound, std::invoke(of, one));
        });
    }
};
inline constexpr upper_bound_algorithm upper_bound;

template <class Iterator>
struct copy_end {
    Iterator out;
};
inline constexpr auto copy = [](auto&& range, auto to) {
    return copy_end<decltype(to)>{std::copy(std::begin(range), std::end(range), to)};
};

inline constexpr auto equal = [](auto&& a, auto&& b, auto... same) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), same...);
};

template <class First, class Second>
struct in_in_result {
    First in1;
    Second in2;
};
inline constexpr auto mismatch = [](auto&& a, auto&& b) {
    const auto [in_a, in_b] = std::mismatch(std::begin(a), std::end(a), std::begin(b), std::end(b));
    return in_in_result<decltype(std::begin(a)), decltype(std::begin(b))>{in_a, in_b};
};

template <class Iterator>
struct min_max {
    Iterator min;
    Iterator max;
};
inline constexpr auto minmax_element = [](auto&& range) {
    const auto [least, most] = std::minmax_element(std::begin(range), std::end(range));
    return min_max<decltype(std::begin(range))>{least, most};
};

} // namespace std::ranges
