// SPDX-License-Identifier: MIT
// TimeHistogram: histogram of durations or delays. One thread writes, any thread reads.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace splinefeed::hal {

/// Bin 0 counts durations below 1 us. Each octave above has four bins: bin i counts durations from edge_us(i - 1) to
/// below edge_us(i). add() takes constant time, without locks or allocation.
class TimeHistogram {
public:
    static constexpr std::size_t octaves = 24; ///< octave i ends at 2^i us; the last one holds 4 s and longer
    static constexpr std::size_t bins_an_octave = 4;
    static constexpr std::size_t bins = 1 + bins_an_octave * (octaves - 1);

    void add(std::uint64_t ns) noexcept;

    [[nodiscard]] std::uint64_t in_bin(std::size_t bin) const noexcept {
        return count_[bin].load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t in_octave(std::size_t octave) const noexcept;
    [[nodiscard]] std::uint64_t total() const noexcept;
    /// The longest duration; 0 if there is none.
    [[nodiscard]] std::uint64_t most_ns() const noexcept { return most_ns_.load(std::memory_order_relaxed); }
    /// A quantile: at least this share (0 to 1) of the durations is below the result, which is rounded up to a bin edge
    /// and never exceeds the longest one. 0 if there is none.
    [[nodiscard]] double below_us(double share) const noexcept;

    /// Upper edge of a bin.
    [[nodiscard]] static double edge_us(std::size_t bin) noexcept;

private:
    std::array<std::atomic<std::uint64_t>, bins> count_{};
    std::atomic<std::uint64_t> most_ns_{0};
};

} // namespace splinefeed::hal
