// SPDX-License-Identifier: MIT
// TimeHistogram: how long something took, or how late it was; written by one thread, read by any.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace splinefeed::hal {

/// Bin 0 counts what was below 1 us, and from there on each octave has four bins: bin i counts what was below
/// edge_us(i) and not in a bin before it. Cost of add(): constant, no lock, no allocation.
class TimeHistogram {
public:
    static constexpr std::size_t octaves = 24; ///< octave i: below 2^i us; the last one: 4 s and longer
    static constexpr std::size_t bins_an_octave = 4;
    static constexpr std::size_t bins = 1 + bins_an_octave * (octaves - 1);

    void add(std::uint64_t ns) noexcept;

    [[nodiscard]] std::uint64_t in_bin(std::size_t bin) const noexcept {
        return count_[bin].load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t in_octave(std::size_t octave) const noexcept;
    [[nodiscard]] std::uint64_t total() const noexcept;
    /// The longest of all. 0 where there is none.
    [[nodiscard]] std::uint64_t most_ns() const noexcept { return most_ns_.load(std::memory_order_relaxed); }
    /// What at least this share of all (0 to 1) stayed below, to a quarter of an octave, and never above the longest
    /// of all. 0 where there is none.
    [[nodiscard]] double below_us(double share) const noexcept;

    /// Where a bin ends.
    [[nodiscard]] static double edge_us(std::size_t bin) noexcept;

private:
    std::array<std::atomic<std::uint64_t>, bins> count_{};
    std::atomic<std::uint64_t> most_ns_{0};
};

} // namespace splinefeed::hal
