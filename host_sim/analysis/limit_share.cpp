// SPDX-License-Identifier: MIT
//
// A segment is a cubic in t/T with the ends p0, p1 and the velocities m0, m1 per segment. In its middle
//
//   v = (6 (p1 - p0) - m0 - m1) / (4 T),   a = (m1 - m0) / T^2,   j = (6 (m0 + m1) - 12 (p1 - p0)) / T^3,
//
// and kappa v^2 is the part of a across v.
#include "host_sim/analysis/limit_share.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

LimitShare::LimitShare(const MachineSettings& machine) : machine_(machine), axes_(static_cast<unsigned>(machine.axes)) {
    const double period_s = machine.sample_period_us * 1e-6;
    chord_mm_s2_ = 8.0 * machine.chord_error_mm / (period_s * period_s);
    for (unsigned k = 0; k < axes_; ++k) {
        axis_[k].mm_per_unit = 1.0 / (static_cast<double>(units_per_count) * machine.axis[k].steps_per_mm);
    }
}

void LimitShare::programmed(std::uint32_t waypoint, double feed_mm_s, bool rapid) {
    const double feed = feed_mm_s > 0.0 ? std::min(feed_mm_s, machine_.max_feed_mm_s) : machine_.max_feed_mm_s;
    if (feeds_.empty() || feeds_.back().waypoint != waypoint) {
        feeds_.push_back({waypoint, feed, rapid});
    }
}

void LimitShare::segment(const FeedSegment& segment, const OperatorState& steered) {
    while (feeds_.size() > 1 && feeds_.front().waypoint != segment.waypoint) {
        feeds_.pop_front();
    }
    const double duration_s = segment.duration_ticks / (ticks_per_us * 1e6);
    const std::uint64_t ticks = segment.duration_ticks;
    bool bound = false;
    bound_ = {};
    most_used_ = 0.0;
    const auto count = [&](std::uint64_t& share, double value, double limit, BindingLimit which) {
        if (limit > 0.0 && value > most_used_ * limit) {
            most_used_ = value / limit;
            most_ = which;
        }
        const bool binds = limit > 0.0 && value >= binding * limit;
        share += binds ? ticks : 0U;
        bound = bound || binds;
        return binds;
    };
    double speed_sq = 0.0;
    double linear_sq = 0.0;
    double acceleration_sq = 0.0;
    double power = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        Axis& axis = axis_[k];
        const double per_s = axis.mm_per_unit / duration_s;
        const auto distance = static_cast<double>(segment.end[k] - segment.start[k]);
        const auto m0 = static_cast<double>(segment.start_velocity[k]);
        const auto m1 = static_cast<double>(segment.end_velocity[k]);
        const double velocity = (6.0 * distance - m0 - m1) * 0.25 * per_s;
        const double acceleration = (m1 - m0) * per_s / duration_s;
        const AxisSettings& limits = machine_.axis[k];
        const auto of = [k](LimitKind kind) {
            return BindingLimit{kind, static_cast<std::uint8_t>(k)};
        };
        bound_.velocity |= count(axis.velocity, std::fabs(velocity), limits.max_velocity_mm_s, of(LimitKind::velocity));
        bound_.acceleration |=
            count(axis.acceleration, std::fabs(acceleration),
                  velocity * acceleration < 0.0 ? limits.braking_mm_s2() : limits.max_acceleration_mm_s2,
                  of(LimitKind::acceleration));
        if (limits.max_jerk_mm_s3 > 0.0) {
            const double jerk = (6.0 * (m0 + m1) - 12.0 * distance) * per_s / (duration_s * duration_s);
            bound_.acceleration |= count(axis.jerk, std::fabs(jerk), limits.max_jerk_mm_s3, of(LimitKind::jerk));
        }
        speed_sq += velocity * velocity;
        linear_sq += limits.rotary ? 0.0 : velocity * velocity;
        acceleration_sq += acceleration * acceleration;
        power += velocity * acceleration;
    }
    const bool turns = !(linear_sq > 0.0) && feed_mm_s() == machine_.max_feed_mm_s;
    const bool steers = steered.override_feed != 1.0 && !turns && (feeds_.empty() || !feeds_.front().rapid);
    const double asked = turns ? max_turning_deg_s(machine_) : feed_mm_s() * (steers ? steered.override_feed : 1.0);
    const double feed = turns ? asked : std::min(asked, machine_.max_feed_mm_s);
    const LimitKind kind = !(feed < machine_.max_feed_mm_s) ? LimitKind::machine_feed
                           : steers                         ? LimitKind::override_feed
                                                            : LimitKind::feed;
    bound_.feed = count(feed_, std::sqrt(linear_sq > 0.0 ? linear_sq : speed_sq), feed, {kind});
    if (bound_.feed && kind != LimitKind::machine_feed) {
        (steers ? override_ : programmed_) += ticks;
    }
    if (machine_.centripetal_mm_s2 > 0.0 || chord_mm_s2_ > 0.0) {
        const double across_sq = speed_sq > 0.0 ? acceleration_sq - power * power / speed_sq : 0.0;
        const double across = std::sqrt(std::max(across_sq, 0.0));
        bound_.acceleration |= count(centripetal_, across, machine_.centripetal_mm_s2, {LimitKind::centripetal});
        bound_.acceleration |= count(chord_, across, chord_mm_s2_, {LimitKind::chord});
    }
    if (steered.standstill != LimitKind::none) {
        (steered.standstill == LimitKind::hold ? hold_ : dwell_) += ticks;
        most_ = {steered.standstill};
        most_used_ = 1.0;
        bound = true;
    }
    none_ += bound ? 0U : ticks;
    total_ += ticks;
}

LimitShares LimitShare::shares() const {
    const auto share = [this](std::uint64_t ticks) {
        return total_ > 0 ? static_cast<double>(ticks) / static_cast<double>(total_) : 0.0;
    };
    LimitShares shares;
    for (unsigned k = 0; k < axes_; ++k) {
        const Axis& axis = axis_[k];
        const bool has_jerk = machine_.axis[k].max_jerk_mm_s3 > 0.0;
        shares.axis.push_back({share(axis.velocity), share(axis.acceleration),
                               has_jerk ? std::optional(share(axis.jerk)) : std::nullopt});
    }
    shares.feed = share(feed_);
    shares.programmed_feed = share(programmed_);
    shares.centripetal = machine_.centripetal_mm_s2 > 0.0 ? std::optional(share(centripetal_)) : std::nullopt;
    shares.chord = chord_mm_s2_ > 0.0 ? std::optional(share(chord_)) : std::nullopt;
    shares.none = share(none_);
    shares.override_feed = share(override_);
    shares.hold = share(hold_);
    shares.dwell = share(dwell_);
    return shares;
}

} // namespace splinefeed::host
