// SPDX-License-Identifier: MIT
// ChainPoints: the points of a run of short lines, as many as the look-ahead holds.
#pragma once

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// A point where two lines of a chain meet. Lengths are in chord units.
template <Scalar S>
struct ChainPoint {
    PerAxis<Position> place{}; ///< as programmed
    PerAxis<S> moved{};        ///< from there to where the spline passes
    PerAxis<S> centre{};       ///< of the ball that `moved` stays in
    S radius{};                ///< of that ball
    S chord{};                 ///< length of the line that ends here
    S arc{};                   ///< length of the smoothed path along that line
    S feed_mm_s{};             ///< of that line
    S max_feed_mm_s{};
    std::uint32_t index = 0; ///< of that line
    bool merged = false;     ///< places nearer than a quarter of the tolerance were left out beside it
    /// The third divided difference of the four points that end here, in units of 2^exponent, without its 3!.
    std::array<S, 4> difference{};
    S weight{}; ///< of its square: a third of the length of these three lines, in the same unit; 0: too uneven
    int exponent = 0;
};

/// A ring of points.
template <Scalar S>
class ChainPoints {
public:
    static constexpr std::size_t capacity = 72;

    explicit ChainPoints(int axes) noexcept : axes_(axes) {}

    [[nodiscard]] int axes() const noexcept { return axes_; }
    [[nodiscard]] std::uint64_t last() const noexcept { return last_; }
    /// The first point that counts: those before are gone, or belong to an earlier run.
    [[nodiscard]] std::uint64_t oldest() const noexcept {
        return last_ + 1 > first_ + capacity ? last_ + 1 - capacity : first_;
    }
    [[nodiscard]] ChainPoint<S>& operator[](std::uint64_t i) noexcept { return ring_[slot(i)]; }
    [[nodiscard]] const ChainPoint<S>& operator[](std::uint64_t i) const noexcept { return ring_[slot(i)]; }

    /// The first point of a new chain.
    void start(const PerAxis<Position>& place) noexcept {
        last_ = first_ = 0;
        last_slot_ = 0;
        ring_[0] = {};
        ring_[0].place = place;
    }
    /// Begins a new run at a point, exactly there.
    void cut(std::uint64_t at) noexcept {
        first_ = at;
        (*this)[at].moved = {};
    }
    ChainPoint<S>& append() noexcept {
        ++last_;
        last_slot_ = ring_index(last_slot_ + 1, capacity);
        ChainPoint<S>& point = ring_[last_slot_];
        point = {};
        return point;
    }
    /// From one programmed point to another.
    void programmed(std::uint64_t from, std::uint64_t to, PerAxis<S>& out) const noexcept {
        out = distances<S>((*this)[from].place, (*this)[to].place, chord_unit_log2, axes_);
    }
    /// From one point of the spline to another.
    void smoothed(std::uint64_t from, std::uint64_t to, PerAxis<S>& out) const noexcept {
        programmed(from, to, out);
        for (const unsigned k : indices(axes_)) {
            out[k] = out[k] + (*this)[to].moved[k] - (*this)[from].moved[k];
        }
    }

private:
    /// A remainder of 64 bits takes small processors hundreds of instructions. @pre last - capacity < i <= last
    [[nodiscard]] std::size_t slot(std::uint64_t i) const noexcept {
        return ring_index(last_slot_ + capacity - static_cast<std::size_t>(last_ - i), capacity);
    }

    int axes_;
    std::uint64_t first_ = 0;
    std::uint64_t last_ = 0;
    std::size_t last_slot_ = 0; // of last_
    std::array<ChainPoint<S>, capacity> ring_{};
};

} // namespace splinefeed
