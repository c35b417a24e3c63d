// SPDX-License-Identifier: MIT
// PathDeviation: how far a path is from the programmed moves, both ways: a second look that shares no code with the
// stage that rounds corners and joins short moves.
#pragma once

#include "host_sim/analysis/path_strand.hpp"
#include "host_sim/config/machine_description.hpp"

#include <deque>
#include <functional>
#include <string>

namespace splinefeed::host {

/// Takes moves and curve segments as they come, each in order; moves before the segments that follow them. A segment
/// names the last move of the run that it belongs to, and only the last two of a run, the halves of a blend, may reach
/// into the next run. So every point of a segment is compared with the moves of its run, the one before that and, of
/// the last two, the next run; and every point of a move with the segments that may follow it. Linear axes are measured
/// together [mm], and so are rotary axes [degrees]. The largest distance is found to 1e-6 of itself or better: at some
/// places, and about the worst of them by a search. Where a bound is not above the largest distance so far, and nothing
/// is too large, it says enough, unless somebody is told of each. Memory: the moves that one segment spans, and the
/// look-ahead. Cost: about three microseconds a move, and ten if somebody is told.
class PathDeviation {
public:
    /// What a move may be off beyond its tolerance, rounding of the scalar and arcs as polynomials aside. [mm, degrees]
    static constexpr double slack_mm = 1e-6;

    /// Where a distance was found.
    struct Place {
        double distance = 0.0;  ///< [mm, degrees]
        std::uint64_t move = 0; ///< from 0
        std::uint64_t line = 0; ///< of the move, as it was told
    };
    /// A distance that is too large.
    struct Excess {
        Place place;
        double allowed = 0.0;
        bool rotary = false;
    };

    /// @param joint_mm  tolerance of joints where the programmed path is exact
    /// @param rounding  of the scalar, as a part of the largest coordinate of a move
    PathDeviation(const MachineSettings& settings, double joint_mm, double rounding);

    /// Who is told of every distance of linear axes that is measured, with its move.
    void tell(std::function<void(std::uint64_t move, double mm)> listener) { listener_ = std::move(listener); }

    void start(const PerAxis<Position>& position);
    void move(const PathElement<double>& move, std::uint64_t line);
    /// The machine stands at the end of the last one: the path passes through it.
    void stop();
    /// @param segment  with the index of the move in `waypoint`, modulo 2^32, as the path delivers it
    void segment(const CurveSegment<double>& segment);
    /// The path is complete: what is left of the moves is measured. Without this call moves that the path did not reach
    /// are not. A path without a segment stands at its start.
    void finish();

    [[nodiscard]] const Place& linear() const noexcept { return largest_[0]; }
    [[nodiscard]] const Place& rotary() const noexcept { return largest_[1]; }
    [[nodiscard]] bool has_rotary() const noexcept { return sets_[1].count > 0; }
    /// The worst one; nothing: every move kept its tolerance.
    [[nodiscard]] const std::optional<Excess>& excess() const noexcept { return excess_; }

private:
    struct Move {
        PathStrand strand;
        PathMode mode = PathMode::continuous;
        double tolerance = 0.0;
        double start_joint = 0.0; ///< what the joints at its ends may be off
        double end_joint = 0.0;
        double rounding = 0.0; ///< and what polynomials are off an arc, and moves that are left out
        std::uint64_t line = 0;
    };
    struct Segment {
        PathStrand strand;
        std::uint64_t first = 0; ///< moves that it may follow
        std::uint64_t last = 0;
        double foot = 0.0; ///< of the place that was compared with it last
    };
    struct Found {
        double distance = 1e150;
        double allowed = 0.0; ///< of the move that forgives most
        std::uint64_t move = 0;
    };

    [[nodiscard]] const Move& of(std::uint64_t index) const noexcept { return moves_[index - oldest_]; }
    [[nodiscard]] double allowed_at_joint(const Move& before, const Move& after) const noexcept;
    [[nodiscard]] double allowed(std::uint64_t index) const noexcept;
    void leave_out(Move& move, double apart);
    void join(Move& move);
    enum class Look : std::uint8_t { quick, thorough };

    [[nodiscard]] Found from_moves(const PerAxis<double>& point, const AxisSet& set, const Segment& among,
                                   std::uint64_t hint) const;
    [[nodiscard]] Found from_moves(const PerAxis<double>& point, const AxisSet& set, const Segment& among,
                                   std::uint64_t hint, Look look) const;
    [[nodiscard]] double from_segments(const PerAxis<double>& point, const AxisSet& set, std::uint64_t move) const;
    [[nodiscard]] double harmless(unsigned set, std::uint64_t move) const noexcept;
    [[nodiscard]] bool is_harmless(const Segment& segment, unsigned set) const noexcept;
    [[nodiscard]] bool is_harmless(const PerAxis<double>& point, unsigned set, std::uint64_t move) noexcept;
    void accept(std::size_t kept, std::uint64_t last);
    void measure_segment(const Segment& segment);
    void measure_move(std::uint64_t index);
    void measure_moves_before(std::uint64_t end);
    void found(unsigned set, const Found& found);

    int axes_;
    double joint_mm_;
    double rounding_;
    std::array<AxisSet, 2> sets_{}; // linear, rotary
    PerAxis<double> reached_mm_{};  // the end of the last segment, first the start
    PerAxis<Position> here_{};
    std::deque<Move> moves_;       // from oldest_
    std::deque<Segment> segments_; // those that the moves from measured_ may have
    std::uint64_t oldest_ = 0;     // one before measured_
    std::uint64_t measured_ = 0;   // moves before it have been measured
    std::deque<Segment> pending_;  // the last segments: the one behind them tells how far they reach
    std::uint64_t run_before_ = 0; // last move of the run before
    std::uint64_t run_ = 0;        // of the run of the last segment
    std::array<Place, 2> largest_{};
    std::function<void(std::uint64_t, double)> listener_;
    std::uint64_t last_whole_ = 0;  // index of the last move that is not negligible
    PerAxis<Position> whole_end_{}; // its end
    double left_out_ = 0.0;         // how far the moves behind it led away from there
    std::optional<Excess> excess_;
};

/// "the path is 0.02 mm from element 3; its tolerance is 0.01 mm"
[[nodiscard]] std::string describe(const PathDeviation::Excess& excess, const std::string& name);

} // namespace splinefeed::host
