// SPDX-License-Identifier: MIT
// MotorAxis: the motor of one axis with a position loop of second order.
#pragma once

namespace splinefeed::host {

struct MotorAxisParameters {
    double bandwidth_hz = 60.0; ///< undamped frequency of the loop, above 0
    double damping = 0.7;       ///< 0 to below 1
    double feed_forward = 1.0;  ///< part of the reference's acceleration that is fed forward; with 1 the shaft follows
                                ///< without error
};

/// With e = reference - position, w = 2 pi bandwidth and the damping z:
///     e'' + 2 z w e' + w^2 e = (1 - feed_forward) reference'' + disturbance
/// This is solved in closed form for an acceleration that is constant over a step. Positions in counts. Cost of a step:
/// a few multiplications; an exponential and two circular functions if its duration changes; nothing if e is at rest.
class MotorAxis {
public:
    explicit MotorAxis(const MotorAxisParameters& parameters = {}) noexcept;

    /// Sets shaft and reference to this position, at standstill.
    void preset_position(double position_counts) noexcept;
    /// Changes the reference; the shaft stays, and the difference becomes following error.
    void refer(double reference_counts) noexcept;
    /// Removes the drive: the shaft stands where it is, and so does the reference.
    void let_go() noexcept;
    /// Lets time pass, in which the reference moves to this position with this mean acceleration. @pre duration_s > 0
    void step(double duration_s, double reference_counts, double acceleration_counts_s2) noexcept;
    /// Acceleration that a load causes from now on.
    void disturb(double acceleration_counts_s2) noexcept { disturbance_ = acceleration_counts_s2; }

    [[nodiscard]] double reference_counts() const noexcept { return reference_; }
    [[nodiscard]] double position_counts() const noexcept { return reference_ - error_; }
    [[nodiscard]] double following_error_counts() const noexcept { return error_; }
    /// Neither error nor load: time changes nothing.
    [[nodiscard]] bool settled() const noexcept { return error_ == 0.0 && error_rate_ == 0.0 && disturbance_ == 0.0; }

private:
    void prepare(double duration_s) noexcept;

    double frequency_;      // w [rad/s]
    double decay_;          // z w
    double ringing_;        // w sqrt(1 - z^2)
    double not_fed_;        // 1 - feed_forward
    double duration_ = 0.0; // the duration for which the next two are computed
    double cosine_ = 1.0;   // exp(-z w t) cos(wd t)
    double sine_ = 0.0;     // exp(-z w t) sin(wd t) / wd
    double reference_ = 0.0;
    double error_ = 0.0;
    double error_rate_ = 0.0;
    double disturbance_ = 0.0;
};

} // namespace splinefeed::host
