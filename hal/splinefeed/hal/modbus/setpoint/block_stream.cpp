// SPDX-License-Identifier: MIT
//
// At a block the drive is at x with velocity v. With ramp A it changes to the velocity w = v + c, in |c| / A, and keeps
// it: after a period T it is at
//
//     x + w T - c |c| / (2 A).
//
// The path is then at distance D. With E = D - v T this requires |c| T - c^2 / (2 A) = |E|, c with the sign of E, so
//
//     |c| = A (T - sqrt(T^2 - 2 |E| / A)); if that does not exist, the drive catches up in later periods.
//
// An error e of v becomes -e r / (1 - r) with the share r = |c| / (A T) of the ramp in a period: a third at r = 1/4.
#include "splinefeed/hal/modbus/setpoint/block_stream.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr double catching_up = 1.1;    // of the largest speed
constexpr double share_of_path = 0.25; // of the ramp, in the path's acceleration (BlockSettings::acceleration)

std::int64_t q16(double physical) noexcept {
    return std::llround(physical * physical_one);
}

} // namespace

BlockStream::BlockStream(const DriveProfile& profile, const BlockSettings& settings)
    : settings_(settings), frames_(profile),
      ramp_(frames_.rounded(FieldRole::profile_acceleration, settings.acceleration)) {
    if (settings_.reserve_us == 0) {
        settings_.reserve_us = settings_.period_us;
    }
    if (const RegisterField* const field = profile.field_of(FieldRole::profile_velocity)) {
        slowest_ = static_cast<double>(physical_of(*field, 1)) / physical_one;
    }
    clamped_ = frames_.set(FieldRole::profile_acceleration, q16(settings.acceleration)).clamped;
    clamped_ = frames_.set(FieldRole::profile_deceleration, q16(settings.acceleration)).clamped || clamped_;
}

void BlockStream::begin(double position_counts) noexcept {
    committed_ = {position_counts, 0.0, position_counts, 0.0};
    model_ = committed_;
    target_ = position_counts;
    speed_ = 0.0;
    previous_arrival_us_ = 0;
    arrival_us_ = 0;
    end_sent_ = false;
}

std::span<const RegisterWrite> BlockStream::prime() noexcept {
    set_move(model_.position, slowest_);
    return frames_.build();
}

void BlockStream::on_arrival(std::uint64_t arrival_us) noexcept {
    if (arrival_us == UINT64_MAX) {
        target_ = committed_.target;
        speed_ = committed_.speed;
        end_sent_ = false;
    } else {
        arrival_us_ = std::max(arrival_us, previous_arrival_us_);
    }
}

// The last block has arrived: the model follows it from then on.
void BlockStream::commit() noexcept {
    committed_.pass(static_cast<double>(arrival_us_ - previous_arrival_us_) / us_per_s, ramp_);
    previous_arrival_us_ = arrival_us_;
    committed_.target = target_;
    committed_.speed = speed_;
}

// The drive ramps to its speed and keeps it until it must brake for its target. If it moves away from the target, or is
// too fast to stop there, it first comes to rest and then reverses; that happens if a block is late while an axis
// reverses.
BlockStream::Move::Phase BlockStream::Move::phase(double ramp) const noexcept {
    constexpr double nothing_counts = 1e-9;
    const double ahead = target - position;
    const double sense = std::copysign(1.0, ahead != 0.0 ? ahead : -velocity);
    const double distance = std::fabs(ahead);
    const double forward = sense * velocity;
    const double braking = forward * forward / (2.0 * ramp);
    if (forward < 0.0 || braking > distance + nothing_counts) {
        return {std::fabs(velocity) / ramp, -std::copysign(ramp, velocity), 0.0, false};
    }
    if (braking >= distance - nothing_counts) {
        return {forward / ramp, -sense * ramp, 0.0, true};
    }
    if (forward == speed) {
        return {speed > 0.0 ? (distance - braking) / speed : HUGE_VAL, 0.0, velocity, false};
    }
    // From w to p and to rest, both with the ramp A, is p^2 / A - w^2 / (2 A).
    const double peak = std::sqrt(ramp * distance + 0.5 * forward * forward);
    const double end = forward > speed ? speed : std::min(speed, peak);
    return {std::fabs(end - forward) / ramp, std::copysign(ramp, sense * (end - forward)), sense * end, false};
}

void BlockStream::Move::pass(double duration_s, double ramp) noexcept {
    constexpr int most_phases = 8; // to rest, back, to its speed, at its speed, to rest: the remainder is rounding
    for (int i = 0; i < most_phases && duration_s > 0.0 && (velocity != 0.0 || position != target); ++i) {
        const Phase now = phase(ramp);
        const double step_s = std::min(now.duration_s, duration_s);
        position += step_s * (velocity + 0.5 * step_s * now.rate);
        velocity += step_s * now.rate;
        duration_s -= step_s;
        if (step_s == now.duration_s) {
            velocity = now.end_velocity;
            position = now.at_target ? target : position;
        }
    }
}

// Velocity with which the drive reaches `there` a period later; empty: not reachable.
std::optional<double> BlockStream::velocity_to(double there, double period_s) const noexcept {
    const double missing = there - model_.position - model_.velocity * period_s;
    const double square = period_s * period_s - 2.0 * std::fabs(missing) / ramp_;
    if (square < 0.0) {
        return std::nullopt;
    }
    return model_.velocity + std::copysign(ramp_ * (period_s - std::sqrt(square)), missing);
}

// Distance of the target beyond a point that the drive passes at `speed`: enough to keep the speed until the next
// block, which may be late, and then to brake.
double BlockStream::beyond(double speed) const noexcept {
    return speed * settings_.reserve_us / us_per_s + speed * speed / (2.0 * ramp_);
}

std::span<const RegisterWrite> BlockStream::block(const TrajectoryBuffer& track,
                                                  const MotionInstant& instant) noexcept {
    commit();
    arrival_us_ = std::max(instant.arrival_us, previous_arrival_us_);
    model_ = committed_;
    model_.pass(static_cast<double>(arrival_us_ - previous_arrival_us_) / us_per_s, ramp_);
    const double period_s = us_to_s(settings_.period_us);
    const double here = static_cast<double>(track.at(settings_.axis, instant.motion_us).position_q16) / physical_one;
    const double there = static_cast<double>(track.at(settings_.axis, instant.next_us).position_q16) / physical_one;
    const bool ends = instant.next_us >= track.end_us();
    if (ends && end_sent_) {
        return {};
    }
    end_sent_ = ends;
    const double path_speed = std::fabs(there - here) / period_s;
    // A drive that catches up is limited to the speed from which half of its ramp can still stop it on the path.
    const double most =
        settings_.fastest > 0.0 ? catching_up * std::max(settings_.fastest, path_speed) : path_speed + ramp_ * period_s;
    const double catch_up = std::min(most, path_speed + std::sqrt(ramp_ * std::fabs(here - model_.position)));
    std::optional<double> wish = velocity_to(there, period_s);
    if (wish && std::fabs(*wish) > most) {
        wish.reset();
    }
    const double speed_there = wish ? std::fabs(*wish) : catch_up;
    if (ends || here == there) { // the drive's own braking reaches the target
        // Fast enough to arrive even if the drive is a count further away than the model.
        const double left = std::max(std::fabs(there - model_.position), 1.0);
        set_move(there, std::max({speed_there, std::min(2.0 * left / period_s, most), slowest_}));
    } else if (!wish) { // it passes the path by no more than a drive that is on it
        set_move(there + std::copysign(beyond(path_speed), there - here), catch_up);
    } else {
        const double speed = frames_.rounded(FieldRole::profile_velocity, std::fabs(*wish));
        const double carried = std::min(speed, path_speed + share_of_path * ramp_ * period_s);
        // A drive that reverses must first come to rest: add that distance.
        const double turning = model_.velocity * *wish < 0.0 ? model_.velocity * model_.velocity / (2.0 * ramp_) : 0.0;
        set_move(model_.position + std::copysign(speed * period_s + beyond(carried) + turning, *wish),
                 std::fabs(*wish));
    }
    return frames_.build();
}

void BlockStream::set_move(double target, double speed) noexcept {
    clamped_ = frames_.set(FieldRole::profile_velocity, q16(speed)).clamped || clamped_;
    clamped_ = frames_.set(FieldRole::target_position, q16(target)).clamped || clamped_;
    speed_ = frames_.rounded(FieldRole::profile_velocity, speed);
    target_ = frames_.rounded(FieldRole::target_position, target);
}

} // namespace splinefeed::hal::modbus
