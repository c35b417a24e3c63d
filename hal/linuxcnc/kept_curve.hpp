// SPDX-License-Identifier: MIT
// KeptCurve: the curve of a path on its way to the plan, of which the last segments are kept for the way back.
#pragma once

#include "splinefeed/s1_curve/curve_filter.hpp"

#include <array>

namespace splinefeed::linuxcnc {

/// Its segments are numbered from 0 at begin(), modulo 2^32, and this number is their waypoint. Until turn() it passes
/// on what comes. The way back is the same Bezier points in the reverse order, with the same feeds and stops; where it
/// ends, there is none (starved). The way forward again is that of before, and then goes on with what comes.
class KeptCurve final : public CurveFilter<double> {
public:
    static constexpr unsigned capacity = 4096; ///< segments, with those that the plan knows ahead of the machine

    void begin(CurveSource<double>& source) noexcept override;
    Pull next(CurveSegment<double>& out) noexcept override;
    [[nodiscard]] bool has_ended() const noexcept override { return false; }

    /// What comes next begins there, at standstill, and leads that way. @pre segment `on` is kept
    /// @param at          where the machine stands: on that segment, or at an end of it
    /// @param backward    the way back
    /// @param least_move  moves before it are not travelled back
    void turn(const PerAxis<Position>& at, std::uint32_t on, bool backward, std::uint32_t least_move) noexcept;
    /// The segments so far are not travelled back.
    void forget() noexcept { oldest_ = newest_; }
    /// The move at the end of a segment. @pre it is kept
    [[nodiscard]] std::uint32_t move_of(std::uint32_t segment) const noexcept { return kept(segment).waypoint; }
    /// The move at the end of the segment before, or of itself where none is kept.
    [[nodiscard]] std::uint32_t move_before(std::uint32_t segment) const noexcept {
        return move_of(segment == oldest_ ? segment : segment - 1U);
    }

private:
    [[nodiscard]] const CurveSegment<double>& kept(std::uint32_t n) const noexcept { return kept_[n % capacity]; }
    void find(std::uint32_t on) noexcept;
    void lead(CurveSegment<double>& out) noexcept;

    CurveSource<double>* source_ = nullptr;
    std::array<CurveSegment<double>, capacity> kept_{};
    std::uint32_t oldest_ = 0;
    std::uint32_t newest_ = 0; // one behind it
    std::uint32_t next_ = 0;
    std::uint32_t last_back_ = 0; // where the way back ends
    PerAxis<Position> at_{};      // where the machine turned,
    double cut_ = 0.0;            // and its parameter on segment next_
    bool backward_ = false;
    bool leads_ = false; // the next segment begins at at_
};

} // namespace splinefeed::linuxcnc
