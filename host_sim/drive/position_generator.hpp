// SPDX-License-Identifier: MIT
// PositionGenerator: the reference of one axis of a positioning drive: velocity trapezoids whose target, speed and
// ramps may change during the move, and cyclic targets.
#pragma once

namespace splinefeed::host {

struct MoveLimits {
    double velocity = 0.0;     ///< [counts/s]; 0: slows down to standstill
    double acceleration = 1.0; ///< [counts/s^2], above 0
    double deceleration = 1.0; ///< [counts/s^2], above 0
};

/// Exact between changes, for any time steps: each phase is computed in closed form.
class PositionGenerator {
public:
    /// Sets the position, at standstill.
    void preset_position(double position_counts) noexcept;
    /// Moves to the target from the present position and speed. If it can no longer stop before the target, it
    /// overshoots and comes back.
    void move(double target_counts, const MoveLimits& limits) noexcept;
    /// Moves on a straight line to the target and arrives after that time; then it stands, unless another target has
    /// come.
    void follow(double target_counts, double duration_s) noexcept;
    /// Slows down to standstill.
    void stop(double deceleration_counts_s2) noexcept;
    void advance(double duration_s) noexcept;

    [[nodiscard]] double position_counts() const noexcept { return position_; }
    [[nodiscard]] double velocity_counts_s() const noexcept { return velocity_; }
    [[nodiscard]] bool at_rest() const noexcept { return course_ == Course::rest; }

private:
    enum class Course { rest, move, line, stop };
    struct Phase {
        double duration_s = 0.0;
        double acceleration = 0.0;
        double end_velocity = 0.0;
        bool at_target = false; // the phase ends at the target
    };

    [[nodiscard]] Phase phase() const noexcept;
    [[nodiscard]] Phase move_phase() const noexcept;
    void end(const Phase& ended) noexcept;

    Course course_ = Course::rest;
    double position_ = 0.0;
    double velocity_ = 0.0;
    double target_ = 0.0;
    double line_left_s_ = 0.0;
    MoveLimits limits_;
};

} // namespace splinefeed::host
