// SPDX-License-Identifier: MIT
// LateHistogram: how late things were, in octaves of time; written by one thread, read by any.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

namespace splinefeed::hal::gpio {

/// Octave i counts what was below 2^i us late, and not in an octave before. Cost: constant, no lock, no allocation.
class LateHistogram {
public:
    static constexpr std::size_t octaves = 24; // the last one: 4 s and longer

    void add(std::uint64_t late_ns) noexcept {
        constexpr std::uint64_t ns_per_us = 1000;
        const std::size_t octave = std::min<std::size_t>(std::bit_width(late_ns / ns_per_us), octaves - 1);
        count_[octave].store(count_[octave].load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        if (late_ns > most_ns_.load(std::memory_order_relaxed)) {
            most_ns_.store(late_ns, std::memory_order_relaxed);
        }
    }
    [[nodiscard]] std::uint64_t count(std::size_t octave) const noexcept {
        return count_[octave].load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t total() const noexcept {
        std::uint64_t sum = 0;
        for (const auto& count : count_) {
            sum += count.load(std::memory_order_relaxed);
        }
        return sum;
    }
    [[nodiscard]] std::uint64_t most_ns() const noexcept { return most_ns_.load(std::memory_order_relaxed); }
    /// Below this time were at least so many of all (share in 0 to 1): the end of an octave. [us]
    [[nodiscard]] std::uint64_t below_us(double share) const noexcept {
        const double wanted = share * static_cast<double>(total());
        double sum = 0.0;
        for (std::size_t i = 0; i < octaves; ++i) {
            sum += static_cast<double>(count(i));
            if (sum >= wanted) {
                return std::uint64_t{1} << i;
            }
        }
        return std::uint64_t{1} << octaves;
    }

private:
    std::array<std::atomic<std::uint64_t>, octaves> count_{};
    std::atomic<std::uint64_t> most_ns_{0};
};

} // namespace splinefeed::hal::gpio
