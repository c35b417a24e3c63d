// SPDX-License-Identifier: MIT
// MotionPlan: the plan that the segment stream follows. It says, one profile segment after another, how the path is
// travelled; SampledPlan, in which numbers.
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"

namespace splinefeed {

/// How the speed changes along a profile segment.
enum class SpeedShape : std::uint8_t {
    line,     ///< v^2 is linear in s: constant acceleration along the path
    parabola, ///< v^2 is a parabola of s with the Bezier points entry_sq, middle_sq, exit_sq
    cubic     ///< s is a cubic of time: constant jerk along the path
};

/// How the machine passes a cell or a part of it, in the numbers in which it is sampled. Speeds are v^2 [mm^2/s^2].
template <Scalar X>
struct ProfileSegment {
    CellInterval<X> stretch{};
    X entry_sq{};
    X exit_sq{};
    bool stops = false; ///< the machine stops at its end and dwells
    SpeedShape shape = SpeedShape::line;
    X middle_sq{};   ///< parabola
    X duration_ms{}; ///< cubic: its length after the fraction y of the time is the profile segment's length times
    X linear{};      ///< linear y + quadratic y^2 + (1 - linear - quadratic) y^3
    X quadratic{};
};

/// Where the machine is on its profile segment.
template <Scalar X>
struct PlanState {
    X fraction{};   ///< fraction of the cell's length
    X speed_sq{};   ///< v^2, or the value that a hold may take for it (SegmentStream)
    X time_share{}; ///< fraction of the profile segment's time
};

/// What became of a change of the steering.
enum class Steered : std::uint8_t {
    busy, ///< the budget is spent
    changed,
    unchanged ///< the profile segment stays as it is, for instance where the place is its end, to rounding
};

/// What the plan does while the input is starved, or its own work is not done.
enum class UnderrunPolicy : std::uint8_t {
    wait,  ///< it asks for more input: the plan does not depend on when the input comes
    drain, ///< it continues along the known path and brakes to standstill at its end: for a machine that cannot wait
    urgent ///< drain, and where the budget is spent before a new plan is made, the old one goes on. It ends at
           ///< standstill. For a machine that moves and has no segment left; what it does then depends on the budget
};

template <Scalar S>
class MotionPlan {
public:
    MotionPlan(const MotionPlan&) = delete;
    MotionPlan& operator=(const MotionPlan&) = delete;

    /// Makes profile_segment() and cell() available. `starved`: the window is not full and nothing is committed
    /// (UnderrunPolicy::drain: there is nothing at all). `held`: the machine stands and must not move. `busy`: the
    /// budget is spent; call again. A plan that cannot be computed in parts ignores the budget.
    virtual Pull prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept = 0;
    /// The same without a bound.
    Pull prepare(UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept {
        WorkBudget unlimited;
        return prepare(underrun, unlimited);
    }
    /// Plans behind what is committed, before prepare() needs it. false: there is nothing to do now.
    virtual bool plan_ahead(WorkBudget& work) noexcept = 0;
    /// @pre the last prepare() answered item; the same for the next three
    [[nodiscard]] virtual const Cell<S>& cell() const noexcept = 0;
    /// The profile segment is done; go on to the next one.
    virtual void advance() noexcept = 0;

    [[nodiscard]] Steering<S>& steering() noexcept { return steering_; }
    [[nodiscard]] const Steering<S>& steering() const noexcept { return steering_; }
    /// Whether the machine stands where its last profile segment ended.
    [[nodiscard]] virtual bool standing() const noexcept = 0;
    /// Forgets every cell, for a new program. @pre standing()
    virtual void clear() noexcept = 0;

protected:
    MotionPlan() noexcept = default;
    ~MotionPlan() = default;

    Steering<S> steering_;
};

/// A plan of cells in the scalar S that is sampled in X.
template <Scalar S, Scalar X = S>
class SampledPlan : public MotionPlan<S> {
public:
    [[nodiscard]] const ProfileSegment<X>& profile_segment() const noexcept { return profile_segment_; }
    /// The machine stopped at this fraction of the cell, on its last profile segment. @pre before the segment's end: at
    /// the end it is advance()
    virtual void rest_at(X fraction) noexcept = 0;
    /// Applies a change of the steering at once, from where the machine is on its profile segment. Without this call
    /// the change applies from the next profile segment on. `busy`: call again, with the same place; or, in a machine
    /// that cannot wait (UnderrunPolicy::urgent), with a later one.
    virtual Steered steer(const PlanState<X>& place, UnderrunPolicy underrun, WorkBudget& work) noexcept = 0;

protected:
    SampledPlan() noexcept = default;
    ~SampledPlan() = default;

    ProfileSegment<X> profile_segment_;
};

} // namespace splinefeed
