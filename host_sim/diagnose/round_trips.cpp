// SPDX-License-Identifier: MIT
#include "host_sim/diagnose/round_trips.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double bins_an_octave = 4.0;

} // namespace

// Upper edge; the first bin ends at 1 us.
double RoundTrips::edge_us(std::size_t bin) noexcept {
    return std::exp2(static_cast<double>(bin) / bins_an_octave);
}

void RoundTrips::add(std::uint64_t us) noexcept {
    const double place = us > 1 ? std::ceil(bins_an_octave * std::log2(static_cast<double>(us))) : 0.0;
    ++bin_[std::min(static_cast<std::size_t>(place), bins - 1)];
    ++count_;
    worst_us_ = std::max(worst_us_, us);
}

double RoundTrips::below_us(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < bins && count_ > 0; ++i) {
        sum += bin_[i];
        if (static_cast<double>(sum) >= wanted) {
            return std::min(edge_us(i), static_cast<double>(worst_us_));
        }
    }
    return 0.0;
}

std::string RoundTrips::picture() const {
    constexpr double widest = 50.0;
    const std::uint64_t largest = *std::max_element(bin_.begin(), bin_.end());
    std::string text;
    for (std::size_t i = 0; i < bins; ++i) {
        if (bin_[i] > 0) {
            const double width = std::ceil(widest * static_cast<double>(bin_[i]) / static_cast<double>(largest));
            text += fmt::format("    below {:>9.0f} us {:>8} {}\n", edge_us(i), bin_[i],
                                std::string(static_cast<std::size_t>(width), '#'));
        }
    }
    return text;
}

} // namespace splinefeed::host
