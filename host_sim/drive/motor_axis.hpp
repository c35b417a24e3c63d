// SPDX-License-Identifier: MIT
// MotorAxis: a motor behind a position loop of second order, one axis.
#pragma once

namespace splinefeed::host {

struct MotorAxisParameters {
    double bandwidth_hz = 60.0; ///< undamped frequency of the loop, above 0
    double damping = 0.7;       ///< 0 to below 1
    double feed_forward = 1.0;  ///< share of the reference's acceleration that is fed forward; 1 follows without error
};

/// With e = reference - position, w = 2 pi bandwidth and the damping z:
///     e'' + 2 z w e' + w^2 e = (1 - feed_forward) reference'' + disturbance
/// in closed form for an acceleration that is constant over a step. Positions in counts. Cost of a step: a few
/// multiplications; an exponential and two circular functions where its duration changes, nothing where e is at rest.
class MotorAxis {
public:
    explicit MotorAxis(const MotorAxisParameters& parameters = {}) noexcept;

    /// The shaft and its reference are here, at rest.
    void preset_position(double position_counts) noexcept;
    /// Another reference; the shaft stays, what lies between becomes following error.
    void refer(double reference_counts) noexcept;
    /// Nothing drives the shaft: it stands where it is, and the reference with it.
    void let_go() noexcept;
    /// Lets time pass in which the reference gets there with this mean acceleration. @pre duration_s > 0
    void step(double duration_s, double reference_counts, double acceleration_counts_s2) noexcept;
    /// What a load does to it from now on.
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
    double duration_ = 0.0; // that the next two are for
    double cosine_ = 1.0;   // exp(-z w t) cos(wd t)
    double sine_ = 0.0;     // exp(-z w t) sin(wd t) / wd
    double reference_ = 0.0;
    double error_ = 0.0;
    double error_rate_ = 0.0;
    double disturbance_ = 0.0;
};

} // namespace splinefeed::host
