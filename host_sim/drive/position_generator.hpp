// SPDX-License-Identifier: MIT
// PositionGenerator: the reference of one axis of a positioning drive: trapezoids of the velocity whose target, speed
// and ramps may change while it moves, and cyclic targets.
#pragma once

namespace splinefeed::host {

struct MoveLimits {
    double velocity = 0.0;     ///< [counts/s]; 0: it slows down to rest
    double acceleration = 1.0; ///< [counts/s^2], above 0
    double deceleration = 1.0; ///< [counts/s^2], above 0
};

/// Exact between changes, whatever the steps of time: each phase is advanced in closed form.
class PositionGenerator {
public:
    /// Here, at rest.
    void preset_position(double position_counts) noexcept;
    /// To the target from wherever it is and however fast. Where it cannot stop before the target any more it
    /// overshoots and comes back.
    void move(double target_counts, const MoveLimits& limits) noexcept;
    /// On a straight line to the target, there after that time; it stands then unless another one has come.
    void follow(double target_counts, double duration_s) noexcept;
    /// Slows down to rest.
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
        bool at_target = false; // where it ends
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
