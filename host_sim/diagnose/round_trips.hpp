// SPDX-License-Identifier: MIT
// RoundTrips: how long answers took, as a histogram.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace splinefeed::host {

/// Four bins an octave from 1 us on; no allocation.
class RoundTrips {
public:
    void add(std::uint64_t us) noexcept;

    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] std::uint64_t worst_us() const noexcept { return worst_us_; }
    /// What that share of the answers stayed below, to a quarter of an octave. 0 where there is none.
    [[nodiscard]] double below_us(double share) const noexcept;
    /// A line for each bin that has any, with a bar; empty where there is none.
    [[nodiscard]] std::string picture() const;

private:
    static constexpr std::size_t bins = 100;

    [[nodiscard]] static double edge_us(std::size_t bin) noexcept;

    std::array<std::uint64_t, bins> bin_{};
    std::uint64_t count_ = 0;
    std::uint64_t worst_us_ = 0;
};

} // namespace splinefeed::host
