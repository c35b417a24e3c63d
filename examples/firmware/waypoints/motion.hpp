// SPDX-License-Identifier: MIT
// Motion: the part of the firmware that plans, in the main loop: waypoints in, parts of motion out.
#pragma once

#include "machine.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/base/slot.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s5_pulse_train/dda_loader.hpp"
#include "splinefeed/trajectory.hpp"

#include <array>

namespace firmware {

/// What the host is told when it happens.
enum class Event : std::uint8_t {
    none,
    done,     ///< the program is complete, and the machine stands at its end
    aborted,  ///< the machine stands, and the rest of the program is forgotten
    held,     ///< the machine stands on the path
    underrun, ///< waypoints came too late: the machine stands on the path, and goes on when more come
    late,     ///< the planner was too slow: the machine slowed down, or stood for a while
    estop,    ///< nothing moves until `reset`
    limit     ///< the same
};

/// One program at a time: waypoints, finish(), and the machine stands at its end. The path from one program to the next
/// is closed: the first waypoint is where the machine stands.
class Motion {
public:
    explicit Motion(Steps& steps) noexcept : steps_(steps) {}

    /// Errors: no_room (the caller keeps the waypoint and tries again), start_elsewhere, and those of
    /// WaypointCurve::push.
    splinefeed::Status push(const splinefeed::Waypoint<Real>& waypoint) noexcept;
    /// No more waypoints will come. Errors: too_few_waypoints.
    splinefeed::Status finish() noexcept;
    /// Steering; without a program nothing happens.
    void hold() noexcept;
    void resume() noexcept;
    void abort() noexcept;
    /// Keeps its value for the programs to come.
    void override_feed(Real ratio) noexcept;
    /// States where the machine stands. false: there is a program.
    bool set_position(const PerAxis<splinefeed::Position>& position) noexcept;
    /// Leaves the state after an emergency stop or a limit switch. false: the machine is not stopped.
    bool reset() noexcept;

    /// A part of the planning, of work_a_call steps at most. Call it as often as possible.
    void plan() noexcept;
    /// What has happened since the last call.
    [[nodiscard]] Event next_event() noexcept;

    [[nodiscard]] bool has_program() const noexcept { return program_ != Program::none; }
    [[nodiscard]] const Steps& steps() const noexcept { return steps_; }

private:
    enum class Program : std::uint8_t { none, open, closed, aborted };

    splinefeed::Status begin(const splinefeed::Waypoint<Real>& first) noexcept;
    /// In this order: a part that begins in between is active.
    [[nodiscard]] bool stands() const noexcept { return steps_.level() == 0 && !steps_.active(); }
    [[nodiscard]] bool make_trajectory(splinefeed::CurveSource<Real>& curve) noexcept;
    void emit() noexcept;

    Steps& steps_;
    std::array<splinefeed::PlannedCell<Real>, board::window> window_{};
    splinefeed::Slot<splinefeed::G2Spline<Real>> curve_;
    splinefeed::AccelerationPlanner<Real> planner_{window_};
    splinefeed::Trajectory<Real> trajectory_;
    splinefeed::DdaLoader loader_{static_cast<int>(axes), tick_ticks};
    splinefeed::FeedSegment segment_;
    MotionPart part_;
    Real feed_ratio_ = splinefeed::literal<Real>(1.0);
    std::uint32_t underruns_ = 0; // those that were reported
    Program program_ = Program::none;
    Stop stopped_ = Stop::none; // what was reported
    bool moved_ = false;        // since the last time that waypoints were missing
    bool finished_ = false;     // the trajectory has no more segments
    bool hold_asked_ = false;   // and not reported yet
};

} // namespace firmware
