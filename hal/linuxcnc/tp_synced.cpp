// SPDX-License-Identifier: MIT
//
// Moves that follow the spindle's position, one behind the other, from rest to rest and without the trajectory.
#include "tp_motion.hpp"

#include "splinefeed/number/vector.hpp"

#include <cmath>

namespace splinefeed::linuxcnc {

// Lengths are those of X Y Z, by which a pitch is meant; without them, of all axes.
SpindleSync::Leg TpMotion::leg(unsigned n, const Mm& from) noexcept {
    const QueuedMove& here = move(n);
    const bool to_bottom = here.taps && state_ != State::tap_returns;
    const Mm way = difference(to_bottom ? here.bottom : here.to, from, machine_.axes);
    const double all_sq = dot(way, way, machine_.axes);
    const double xyz_sq = dot(way, way, smaller(machine_.axes, 3));
    SpindleSync::Leg out;
    out.length = std::sqrt(xyz_sq > 0.0 ? xyz_sq : all_sq);
    out.pitch = here.pitch_mm;
    out.both_ways = to_bottom;
    out.limits.velocity = out.limits.acceleration = out.limits.jerk = largest<double>();
    for (const unsigned k : indices(machine_.axes)) {
        const double part = std::fabs(way[k]) / out.length / scale(k);
        if (part > 0.0) {
            out.limits.velocity = smaller(out.limits.velocity, machine_.velocity[k] / part);
            out.limits.acceleration = smaller(out.limits.acceleration, machine_.acceleration[k] / part);
            out.limits.jerk =
                machine_.jerk[k] > 0.0 ? smaller(out.limits.jerk, machine_.jerk[k] / part) : out.limits.jerk;
        }
    }
    out.shares = (goes_on(n) && overlaps(n - 1U)) || (goes_on(n + 1U) && overlaps(n));
    return out;
}

// Move n follows the spindle behind one that does.
bool TpMotion::goes_on(unsigned n) noexcept {
    return n != last_ && move(n).pitch_mm > 0.0 && !move(n).stands_before;
}

// Without a tolerance none begins before the one before it is over.
bool TpMotion::overlaps(unsigned n) noexcept {
    return move(n).element.tolerance_mm > 0.0;
}

// What may be left of the move under way when the next one begins, to round the corner within the tolerance.
double TpMotion::left_to_join() noexcept {
    const QueuedMove& here = move(first_);
    const double cosine = dot(here.out, move(first_ + 1U).in, machine_.axes);
    const double sine = cosine > 0.0 ? std::sqrt(larger(1.0 - cosine * cosine, 0.0)) : 1.0;
    return here.element.tolerance_mm / larger(sine, 1e-6);
}

void TpMotion::run_synced(const tpc_input& input, tpc_output& output) noexcept {
    const bool stops = input.abort != 0 || failed_;
    if (state_ == State::sync_waits && (stops || input.may_begin == 0)) {
        if (stops) {
            forget();
        }
        return;
    }
    if (state_ == State::sync_waits) {
        state_ = State::sync;
        sync_from_ = at_;
        pushed_ = first_ + 1U;
        sync_.begin(leg(first_, at_), turns_, turns_per_s_);
    }
    if (stops) {
        sync_.brake();
    } else if (move(first_).taps) {
        tap(output);
    } else {
        follow_spindle();
    }
    const bool to_bottom = move(first_).taps && state_ != State::tap_returns;
    for (const unsigned k : indices(machine_.axes)) {
        const double corner = to_bottom ? move(first_).bottom[k] : move(first_).to[k];
        at_[k] = sync_from_[k] + (corner - sync_from_[k]) * sync_.first().part();
        at_[k] += sync_.joined() ? (move(first_ + 1U).to[k] - corner) * sync_.second().part() : 0.0;
    }
    if (stops && sync_.rests()) {
        forget();
    } else if (!stops && sync_.first().at_end()) {
        sync_from_ = move(first_).to;
        ++first_;
        if (!sync_.joined()) {
            at_ = sync_from_; // to the last digit
            if (goes_on(first_)) {
                sync_.join(leg(first_, at_));
                ++pushed_;
            }
        }
        state_ = sync_.joined() ? State::sync : State::no_path;
        sync_.leave();
        output.complete = first_ == last_ ? 1 : 0;
        if (output.complete != 0) {
            forget();
        }
    }
}

// In with the spindle, back with it when it turns back, and from where the machine then stops to where it began.
void TpMotion::tap(tpc_output& output) noexcept {
    switch (state_) {
    case State::sync:
        follow_spindle();
        if (sync_.first().left() <= 0.0) {
            state_ = State::tap_back;
            output.reverses = 1;
        }
        break;
    case State::tap_back:
        follow_spindle();
        if (sync_.first().part() <= 0.0) {
            state_ = State::tap_stops;
            output.reverses = 2;
        }
        break;
    case State::tap_stops:
        if (sync_.rests()) {
            state_ = State::tap_returns;
            sync_from_ = at_;
            sync_.begin(leg(first_, at_), 0.0, 0.0);
        }
        sync_.brake();
        break;
    default: sync_.go_on(); break; // tap_returns
    }
}

void TpMotion::follow_spindle() noexcept {
    if (sync_.too_fast()) {
        fail("the spindle is too fast for its pitch: an axis would exceed its velocity");
        sync_.brake();
        return;
    }
    sync_.run(turns_);
    if (goes_on(first_ + 1U) && sync_.may_join(left_to_join())) {
        sync_.join(leg(first_ + 1U, move(first_).to));
        ++pushed_;
    }
    if (sync_.joined()) {
        sync_.run_joined();
    }
}

} // namespace splinefeed::linuxcnc
