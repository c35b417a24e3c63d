// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/time_histogram.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <bit>

namespace splinefeed::hal {

namespace {

// Powers of 2^(1/4): where the bins of an octave end, as multiples of its beginning.
constexpr std::array<double, TimeHistogram::bins_an_octave> quarter_end{1.1892071150027210667, 1.4142135623730950488,
                                                                        1.6817928305074290861, 2.0};

std::size_t bin_of(std::uint64_t ns) noexcept {
    const auto octave = static_cast<std::size_t>(std::bit_width(ns / ns_per_us));
    if (octave == 0) {
        return 0;
    }
    if (octave >= TimeHistogram::octaves) {
        return TimeHistogram::bins - 1;
    }
    const auto begins_ns = static_cast<double>(ns_per_us << (octave - 1));
    std::size_t quarter = 0;
    while (quarter + 1 < quarter_end.size() && static_cast<double>(ns) >= begins_ns * quarter_end[quarter]) {
        ++quarter;
    }
    return 1 + TimeHistogram::bins_an_octave * (octave - 1) + quarter;
}

} // namespace

void TimeHistogram::add(std::uint64_t ns) noexcept {
    auto& count = count_[bin_of(ns)];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (ns > most_ns_.load(std::memory_order_relaxed)) {
        most_ns_.store(ns, std::memory_order_relaxed);
    }
}

std::uint64_t TimeHistogram::in_octave(std::size_t octave) const noexcept {
    if (octave == 0) {
        return in_bin(0);
    }
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < bins_an_octave; ++i) {
        sum += in_bin(1 + bins_an_octave * (octave - 1) + i);
    }
    return sum;
}

std::uint64_t TimeHistogram::total() const noexcept {
    std::uint64_t sum = 0;
    for (const auto& count : count_) {
        sum += count.load(std::memory_order_relaxed);
    }
    return sum;
}

double TimeHistogram::below_us(double share) const noexcept {
    const double wanted = share * static_cast<double>(total());
    const double most_us = static_cast<double>(most_ns()) / static_cast<double>(ns_per_us);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < bins; ++i) {
        sum += static_cast<double>(in_bin(i));
        if (sum >= wanted) {
            return std::min(edge_us(i), most_us);
        }
    }
    return most_us;
}

double TimeHistogram::edge_us(std::size_t bin) noexcept {
    if (bin == 0) {
        return 1.0;
    }
    const auto octave = static_cast<double>(std::uint64_t{1} << ((bin - 1) / bins_an_octave));
    return octave * quarter_end[(bin - 1) % bins_an_octave];
}

} // namespace splinefeed::hal
