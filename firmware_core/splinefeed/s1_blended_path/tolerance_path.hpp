// SPDX-License-Identifier: MIT
// TolerancePath: programmed moves to the smoothest path within their tolerance.
#pragma once

#include "splinefeed/s1_blended_path/blended_path.hpp"
#include "splinefeed/s1_blended_path/chain_smoother.hpp"

namespace splinefeed {

/// What became of the moves so far.
struct PathCounts {
    std::uint64_t moves = 0;    ///< pushed
    std::uint64_t segments = 0; ///< delivered
    std::uint64_t chains = 0;   ///< runs of short lines that became splines
    JointCounts joints{};
};

/// A source of Bezier segments. Push moves until it is full; next() makes room. Chains of short lines become the
/// longest G2 quintics within their tolerance (ChainSmoother); other joints are rounded (BlendedPath).
/// A move below 0.1 um is left out. That moves the start of the next one. An arc that is so small, 3 um of radius at
/// most, that its ends do not fit any more becomes its chord. CurveSegment::waypoint is the index, modulo 2^32, of the
/// move at the segment's end, from 0. The path depends neither on feeds nor on the times of the calls. Memory and cost:
/// those of both. Available if SPLINEFEED_MAX_DEGREE is at least 5.
template <Scalar S>
class TolerancePath final : public CurveSource<S> {
public:
    /// @param rules  those of the machine: path_rules()
    TolerancePath(int axes, const PathRules<S>& rules) noexcept
        : axes_(axes), rotary_(rules.rotary), has_rotary_(any(rules.rotary)), chains_(axes, rules.sharpest.half_sine),
          blended_(axes, rules) {}

    /// Where the first move begins. Call it once, before push(). Errors: position_out_of_range.
    Status start(const PerAxis<Position>& position) noexcept;
    /// Whether push() would accept a move.
    [[nodiscard]] bool has_room() const noexcept { return chains_.has_room(); }
    /// Accepts the next move. After an error nothing has changed. Errors: no_room, input_finished,
    /// position_out_of_range, move_too_long, arc_invalid, curve_invalid, tolerance_out_of_range.
    Status push(const PathElement<S>& element) noexcept;
    /// Tells that no more moves will come. Error: too_few_waypoints where none had a length.
    Status finish() noexcept;

    Pull next(CurveSegment<S>& out) noexcept override;

    [[nodiscard]] PathCounts counts() const noexcept {
        return {counts_.moves, counts_.segments, chains_.chains(), blended_.joints()};
    }

private:
    bool pass_on() noexcept;
    [[nodiscard]] static bool any(const PerAxis<bool>& axes) noexcept {
        bool some = false;
        for (const bool axis : axes) {
            some = some || axis;
        }
        return some;
    }
    [[gnu::noinline]] void feed_along_path(PathElement<S>& element) const noexcept; // its stack is for these alone

    int axes_;
    PerAxis<bool> rotary_;
    bool has_rotary_;
    ChainSmoother<S> chains_;
    BlendedPath<S> blended_;
    PerAxis<Position> last_{}; // end of the last move that was pushed
    bool moves_ = false;       // one of them had a length
    bool finished_ = false;
    PathCounts counts_{};
};

} // namespace splinefeed
