// SPDX-License-Identifier: MIT
#include "host_sim/ports/histogram_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

std::string histogram_picture(const hal::TimeHistogram& times) {
    constexpr double widest = 50.0;
    std::uint64_t largest = 0;
    for (std::size_t i = 0; i < hal::TimeHistogram::bins; ++i) {
        largest = std::max(largest, times.in_bin(i));
    }
    std::string text;
    for (std::size_t i = 0; i < hal::TimeHistogram::bins; ++i) {
        if (const std::uint64_t count = times.in_bin(i); count > 0) {
            const double width = std::ceil(widest * static_cast<double>(count) / static_cast<double>(largest));
            text += fmt::format("    below {:>9.0f} us {:>8} {}\n", hal::TimeHistogram::edge_us(i), count,
                                std::string(static_cast<std::size_t>(width), '#'));
        }
    }
    return text;
}

} // namespace splinefeed::host
