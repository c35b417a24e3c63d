// SPDX-License-Identifier: MIT
// BlendedPath: programmed moves to a G2 path within a tolerance of them.
#pragma once

#include "splinefeed/s1_blended_path/joint.hpp"
#include "splinefeed/s1_blended_path/line_parts.hpp"
#include "splinefeed/s1_blended_path/path_rules.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed {

/// What became of the joints so far.
struct JointCounts {
    std::uint64_t blended = 0;
    std::uint64_t stopped = 0; ///< with the end of the path
    std::uint64_t through = 0;
};

/// A source of Bezier segments. Push moves until it is full; next() makes room. Where two moves meet it does what their
/// PathMode says: a stop, or a blend within the tolerance of both (joint.hpp); arcs become quintics. Class: G2 except
/// at stops, where the path is exact. The path does not depend on feeds, nor on the times of the calls. Moves shorter
/// than 0.1 um are dropped. A move that lies between two blends is shared: each gets what it needs if there is room,
/// and otherwise half, or what the other one leaves.
///
/// Look-ahead: two moves. Memory: a ring of eight moves. Cost per move: four roots and some twenty divisions between
/// lines. Available if SPLINEFEED_MAX_DEGREE is at least 5.
template <Scalar S>
class BlendedPath final : public CurveSource<S> {
public:
    BlendedPath(int axes, const PathRules<S>& rules) noexcept
        : axes_(axes), rounds_curvature_(rules.rounds_curvature),
          joint_tolerance_(scale2(rules.joint_tolerance_mm, -chord_unit_log2)),
          sharpest_{scale2(smaller(rules.sharpest.curvature_1_mm, from_integer<S>(most_sharpest)),
                           bend_log2 + chord_unit_log2),
                    rules.sharpest.fading, rules.sharpest.half_sine},
          smooth_{rules.smooth.jump, scale2(rules.smooth.bend_1_mm, bend_log2 + chord_unit_log2)}, kink_(rules.kink),
          roundest_(rules.roundest) {}

    /// Where the first move begins. Call it once, before push(). Errors: position_out_of_range.
    Status start(const PerAxis<Position>& position) noexcept;
    /// Whether push() would accept a move.
    [[nodiscard]] bool has_room() const noexcept { return known_ - next_ < capacity; }
    /// The length of a move in chord units, below 0.1 um 0. Errors: position_out_of_range, move_too_long, arc_invalid,
    /// curve_invalid, tolerance_out_of_range.
    [[nodiscard]] static Result<S> length_of(const PerAxis<Position>& from, const PathElement<S>& element,
                                             int axes) noexcept;
    /// Accepts the next move. After an error nothing has changed. Errors: no_room, input_finished, and those of
    /// check().
    /// @param index  what CurveSegment::waypoint will be
    Status push(const PathElement<S>& element, std::uint32_t index) noexcept;
    /// Tells that no more moves will come. Error: too_few_waypoints where there was none.
    Status finish() noexcept;

    Pull next(CurveSegment<S>& out) noexcept override;

    /// Where moves end within a line. A segment ends there, where the line is not rounded.
    [[nodiscard]] LineParts& parts() noexcept { return parts_; }

    /// Of the moves that were delivered.
    [[nodiscard]] const JointCounts& joints() const noexcept { return counts_; }

private:
    static constexpr std::uint64_t capacity = 8;
    static constexpr std::int32_t most_sharpest = 1 << 20; // 1/mm

    /// A move, and the joint at its end.
    struct Entry {
        PathMove<S> move;
        Joint<S> joint{};
        S tolerance{};
        S tolerance_at_end{}; // at most that
        S left_out{};         // how far moves behind it went that were too short to be any
        S feed_mm_s{};
        S max_feed_mm_s{};
        bool feed_along_path = false;
        PathMode mode = PathMode::continuous;
        bool stop_at_end = false;
        bool joined = false;
        std::uint32_t index = 0;
    };
    enum class Stage : std::uint8_t { joint, body, blend, second_half };

    [[nodiscard]] Entry& entry(std::uint64_t i) noexcept { return ring_[i % capacity]; }
    [[nodiscard]] const Entry& entry(std::uint64_t i) const noexcept { return ring_[i % capacity]; }
    [[nodiscard]] S wish(std::uint64_t i) const noexcept;
    void decide(std::uint64_t i) noexcept;
    void fit_joint() noexcept;
    [[nodiscard]] static Status measure(const PerAxis<Position>& from, const PathElement<S>& element, int axes,
                                        PathMove<S>& out) noexcept;
    void describe(const Entry& of, int degree, CurveSegment<S>& out) const noexcept;
    void emit_body(CurveSegment<S>& out) noexcept;
    int piece_of(const PathMove<S>& move, bool last, PerAxis<PerDegree<S>>& points,
                 PerAxis<Position>& there) const noexcept;
    void place_ends(PerAxis<PerDegree<S>>& points, int degree, const PerAxis<Position>& there) const noexcept;
    void emit_blend(CurveSegment<S>& out) noexcept;
    void leave(CurveSegment<S>& out) noexcept;

    int axes_;
    bool rounds_curvature_;
    S joint_tolerance_;         // chord units
    SharpestBlend<S> sharpest_; // in units of 2^-bend_log2 per chord unit
    SmoothJoint<S> smooth_;     // likewise
    PassedKink<S> kink_;
    S roundest_;
    std::array<Entry, capacity> ring_{};
    PerAxis<Position> last_{}; // end of the last move that was pushed
    PerAxis<Position> here_{}; // end of the last segment that was delivered
    Blend<S> blend_{};         // at the end of the present move
    S before_{};               // what the blend before the present move takes of it
    S before_wish_{};          // what it wished to take
    S after_{};                // what the blend behind it takes
    int pieces_ = 0;
    int piece_ = 0;
    Stage stage_ = Stage::joint;
    bool stops_ = false; // at the end of the present move
    bool finished_ = false;
    bool started_ = false;
    std::uint64_t known_ = 0; // moves pushed
    std::uint64_t next_ = 0;  // the present move
    JointCounts counts_{};
    LineParts parts_;
};

} // namespace splinefeed
