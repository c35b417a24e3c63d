// SPDX-License-Identifier: MIT
// OptimumTime: the least time in which the axes can follow the curve, computed in another way than the plan.
//
//      b |      /\    ______       the speed limits of the nodes
//        |  ___/  \__/      \      backward: the largest b from which what follows can be reached
//        | /                 \     forward: the largest b that can be reached
//        +-----------------------> s
//        ^committed     ^half     ^end of the window: any b
#pragma once

#include "host_sim/analysis/path_grid.hpp"
#include "host_sim/base/compensated_sum.hpp"

#include <cstddef>
#include <cstdint>

namespace splinefeed::host {

/// Takes the curve's segments in the order of travel. The curve starts and ends at standstill, and stops where the plan
/// stops (PathGrid). Velocity, acceleration, programmed feed, centripetal and chord limits are used in full. Jerk is
/// ignored, so this is a lower bound for machines with and without a jerk limit.
///
/// Limits are required only at the nodes of a grid, and none after the window: everything that a machine can do is
/// allowed. The grid can make the result too large, by up to 2.4e-4 of it in 12,000 random paths, and too small, by up
/// to 5.5e-2 where the limits of the axes differ by powers of ten (0.0005 on the butterfly); tests/host measures both.
/// Memory: the window. Cost: about 0.2 us per node for three axes; each node is visited about three times, whatever the
/// window.
class OptimumTime {
public:
    static constexpr std::size_t usual_window = 4096; ///< 1 MB

    /// @param direction_jump  Refinement::direction_jump of the plan
    /// @param scalar  of the plan
    /// @pre window >= 4
    OptimumTime(const MachineSettings& machine, double direction_jump, ScalarKind scalar = ScalarKind::float64,
                std::size_t window = usual_window);

    void segment(const CurveSegment<double>& segment);

    /// The curve ends here, at standstill. A second call has no effect.
    void finish();

    /// @pre finish() was called
    [[nodiscard]] double seconds() const noexcept { return seconds_.value(); }
    [[nodiscard]] std::uint64_t nodes() const noexcept { return nodes_; }

private:
    struct Stage {
        PathInterval interval;
        double limit_sq = 0.0; ///< upper bound of b at its start, from both sides
        double reach_sq = 0.0; ///< largest b at its start from which the rest can be travelled
    };

    void add(const PathInterval& interval);
    void advance(double end_sq, std::size_t count);
    [[nodiscard]] double before(const Stage& stage, double end_sq) const noexcept;
    [[nodiscard]] double after(const PathInterval& interval, double start_sq) const noexcept;
    [[nodiscard]] double time(const PathInterval& interval, double start_sq, double end_sq) const noexcept;

    PathGrid grid_;
    unsigned axes_;
    PerAxis<double> speeding_{};
    PerAxis<double> braking_{};
    std::size_t window_;
    std::vector<PathInterval> fresh_; // of one segment
    std::vector<Stage> stages_;       // from the committed node on
    double start_sq_ = 0.0;           // b at the committed node
    CompensatedSum seconds_;
    std::uint64_t nodes_ = 0;
};

} // namespace splinefeed::host
