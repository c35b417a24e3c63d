// SPDX-License-Identifier: MIT
// PathGrid: the exact curve, divided into short intervals, with the limits of the speed at their ends.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <vector>

namespace splinefeed::host {

/// An interval between two neighbouring nodes of the grid. Values at its ends are those of its own side: at a joint of
/// the curve the curvature may jump. Speeds are squared, b = (ds/dt)^2.
struct PathInterval {
    PerAxis<double> entry_slope{}; ///< |dq/ds| at its start
    PerAxis<double> exit_slope{};
    PerAxis<double> travel_mm{}; ///< distance that the axis travels, in both directions together
    double noise_mm = 0.0;       ///< error of each travel by rounding
    double length_mm = 0.0;
    double entry_cap_sq = 0.0; ///< largest b at its start, for any acceleration along the path; finite
    double exit_cap_sq = 0.0;
    double middle_cap_sq = 0.0; ///< the same in its middle, approximately
    bool stop_before = false;   ///< b = 0 at its start
};

/// Uses the limits as the machine file states them, without the margins of the plan. The path length is taken over all
/// axes, as in the plan.
///
/// The stops are those of the plan: a corner (CurveSegment::stop_at_end, from --corner-angle or a corner waypoint), a
/// change of direction at a joint above `direction_jump`, a joint where the tangent of a segment vanishes, and a cusp
/// within a segment. In doubt there is no stop.
///
/// In an interval the direction turns by less than 0.05 rad, and the speed limits at the ends and in the middle differ
/// by less than 15 %, as far as intervals of 2^-20 and 2^-8 of a segment allow. A curved segment has at least four
/// intervals, or sixteen if it is longer than a quarter of the braking distance. Cost: one evaluation with two
/// derivatives per node, and one with one derivative in between.
class PathGrid {
public:
    /// @param direction_jump  Refinement::direction_jump of the plan
    /// @param scalar  of the plan
    PathGrid(const MachineSettings& machine, double direction_jump, ScalarKind scalar = ScalarKind::float64);

    /// Appends the intervals of a segment. @pre segments come in travel order
    void append(const CurveSegment<double>& segment, std::vector<PathInterval>& out);

private:
    struct Node {
        double u = 0.0;
        PerAxis<double> position{}; ///< from the segment's origin [mm]
        PerAxis<double> direction{};
        PerAxis<double> curvature{};
        double sigma = 0.0; ///< |dr/du|
        double slope = 0.0; ///< dsigma/du
        double cap_sq = 0.0;
    };

    /// @param start,end  first and last leg of the control polygon
    void take_powers(const CurveSegment<double>& segment, PerAxis<double>& start, PerAxis<double>& end);
    /// @pre take_powers(). 0: the machine's feed
    void take_feed(double programmed_mm_s);
    /// Zero where it is next to nothing.
    void normalise(PerAxis<double>& direction) const;
    void append_pieces(std::vector<PathInterval>& out);
    [[nodiscard]] Node node(double u) const noexcept;
    [[nodiscard]] double acceleration(unsigned k, double slope, bool speeding) const noexcept;
    [[nodiscard]] double feed_cap_sq(const PerAxis<double>& q1) const noexcept;
    [[nodiscard]] double cap_sq(const PerAxis<double>& q1, const PerAxis<double>& q2) const noexcept;
    [[nodiscard]] double sigma(double u) const noexcept;
    [[nodiscard]] PathInterval interval(const Node& from, const Node& to) const noexcept;
    [[nodiscard]] static double length_error(const Node& from, const Node& to, double length_mm) noexcept;
    [[nodiscard]] double bend(const Node& from, const Node& to, double length_mm) const noexcept;
    [[nodiscard]] bool jumps(const PerAxis<double>& in, const PerAxis<double>& out, double slack) const noexcept;

    MachineSettings machine_;
    unsigned axes_;
    double direction_jump_;
    double direction_error_;  // of the plan's arithmetic
    double negligible_units_; // a shorter tangent is none
    double chord_mm_s2_;      ///< largest kappa v^2 for the chord error; 0: no limit
    double softest_mm_s2_;
    double turning_sq_ = 0.0; ///< of all rotary axes at their velocity limits
    // The segment that is being divided.
    PerAxis<PerDegree<double>> power_{}; ///< position = sum power u^i [mm]
    unsigned degree_ = 1;
    double size_mm_ = 0.0; ///< largest coordinate
    double feed_sq_ = 0.0;
    double fastest_sq_ = 0.0; ///< above every cap; feed_sq_ if the feed counts all moving axes
    int least_level_ = 0;     ///< halvings
    // The end of the previous segment.
    PerAxis<double> last_direction_{}; ///< zero: the tangent vanishes
    bool stop_ = false;
    bool any_ = false;
};

} // namespace splinefeed::host
