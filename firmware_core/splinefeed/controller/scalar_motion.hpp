// SPDX-License-Identifier: MIT
// ScalarMotion: a LineMotion in one scalar: interpreter, path within a tolerance, trajectory.
#pragma once

#include "splinefeed/controller/line_motion.hpp"
#include "splinefeed/controller/line_numbers.hpp"
#include "splinefeed/controller/travel_guard.hpp"
#include "splinefeed/s0_program/interpreter.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"
#include "splinefeed/trajectory.hpp"

namespace splinefeed {

/// A move waits until the next one, or a pause of the input, tells whether the machine stands at its end. The path is
/// made anew at each restart(). Memory: that of Interpreter and TolerancePath.
template <Scalar S>
class ScalarMotion final : public LineMotion {
public:
    /// All arguments but the rules must outlive it. @param rules  path_rules() of the machine
    /// @param points  for curves through points, G5.5; none: they are refused
    /// @pre Trajectory::make() accepts limits and planner
    ScalarMotion(const ControllerSettings& settings, const MotionLimits<S>& limits, Planner<S>& planner,
                 const PathRules<S>& rules = rules_cast<S>(path_rules(MachineSettings{})),
                 PointCurve<S>* points = nullptr) noexcept;

    [[nodiscard]] BlockInterpreter& interpreter() noexcept override { return interpreter_; }
    LineProgress pass_on() noexcept override;
    void leave_out() noexcept override;
    [[nodiscard]] const Waiting& waiting() const noexcept override { return waiting_; }
    void carried_out() noexcept override { waits_ = false; }
    void begin_waiting() noexcept override;
    LineProgress pass_jog() noexcept override;
    bool take_event(ProgramEvent& out) noexcept override;

    Pull next(FeedSegment& out, Supply supply) noexcept override;
    bool look_ahead() noexcept override;
    [[nodiscard]] bool exhausted() const noexcept override {
        return exhausted_ && !holds_ && !interpreter_.has_curve();
    }
    [[nodiscard]] bool at_rest() const noexcept override { return at_rest_; }
    [[nodiscard]] std::uint32_t line_of(std::uint32_t waypoint) const noexcept override {
        return line_numbers_.find(waypoint);
    }
    [[nodiscard]] bool left_travel() const noexcept override {
        return refused_ || guard_->has_ended() || !trajectory_.status().ok();
    }

    void hold() noexcept override { trajectory_.hold(); }
    void resume() noexcept override { trajectory_.resume(); }
    void abort() noexcept override { trajectory_.abort(); }
    [[nodiscard]] Activity activity() const noexcept override { return trajectory_.activity(); }
    void set_overrides(int feed, int rapids) noexcept override;
    void restart() noexcept override;
    void place(const PerAxis<Position>& position) noexcept override;

private:
    static constexpr std::size_t most_events = 8;
    struct Event {
        ProgramEvent event{};
        std::uint32_t behind = 0; // so many moves
    };

    void build_path() noexcept;
    [[nodiscard]] bool needs_rest() const noexcept;
    [[nodiscard]] bool is_due_at_once() const noexcept;
    LineProgress pass_item() noexcept;
    LineProgress pass_move() noexcept;
    bool release(bool stops) noexcept;
    void let_go() noexcept;
    void take_move() noexcept;
    [[nodiscard]] bool leaves_travel(const PerAxis<Position>& place) const noexcept;
    void cut(PathElement<S>& element) const noexcept;

    const ControllerSettings* settings_;
    const MotionLimits<S>* limits_;
    Planner<S>* planner_;
    PathRules<S> rules_;
    Interpreter<S> interpreter_;
    Slot<TolerancePath<S>> path_;
    Slot<TravelGuard<S>> guard_;
    Trajectory<S> trajectory_;
    ProgramItem<S> item_;
    PathElement<S> held_;
    std::uint32_t held_line_ = 0;
    LineNumbers line_numbers_; // of the moves in the path
    Waiting waiting_;
    std::array<Event, most_events> events_{};
    std::size_t event_count_ = 0;
    PerAxis<Position> here_{};  // where the moves so far end
    PerAxis<Position> place_{}; // where the motion began
    std::uint32_t pushed_ = 0;  // moves in the path
    std::uint32_t reached_ = 0; // the move that the last segment belongs to
    bool item_pending_ = false; // item_ is still to be passed on
    bool holds_ = false;
    bool waits_ = false;
    bool moved_ = false; // a segment was delivered since place()
    bool at_rest_ = true;
    bool exhausted_ = true;
    bool refused_ = false; // the path took no move
};

extern template class ScalarMotion<double>;
extern template class ScalarMotion<float>;
extern template class ScalarMotion<Fixed>;

} // namespace splinefeed
