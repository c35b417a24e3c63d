// SPDX-License-Identifier: MIT
//
// The machine along the segments, and the move that it is on.
//
// A segment names the move at the end of its piece of path: of a piece that stands for many short lines the last one,
// of a rounded corner the one before it. A move is left where the machine passes the plane through its end that halves
// the angle to the next one.
#include "tp_motion.hpp"

#include <cmath>

namespace splinefeed::linuxcnc {

namespace {

constexpr double mm_per_unit_of_segment = 1.0 / (1024.0 * static_cast<double>(units_per_count));
constexpr unsigned most_left = 64; // moves that are over, in a period
constexpr double rounding_s = 1e-12;
constexpr double half_turn_rad = 3.141592653589793;
constexpr double turns_back = 1e-6; // 1 + the cosine of the angle to the next move
constexpr double shares = 1 << 20;  // steps of a feed's factor

double seconds(const FeedSegment& segment) noexcept {
    return static_cast<double>(segment.duration_ticks) / ticks_per_s;
}

} // namespace

// On the cubic of the present segment.
Mm TpMotion::place() const noexcept {
    const double u = smaller(in_now_s_ / seconds(now_), 1.0);
    const double w = 1.0 - u;
    Mm out{};
    for (const unsigned k : indices(machine_.axes)) {
        const auto start = static_cast<double>(now_.start[k]);
        const double units = static_cast<double>(now_.end[k] - now_.start[k]) * u * u * (3.0 - 2.0 * u) +
                             static_cast<double>(now_.start_velocity[k]) * u * w * w -
                             static_cast<double>(now_.end_velocity[k]) * u * u * w;
        out[k] = (start + units) * mm_per_unit_of_segment;
    }
    return out;
}

bool TpMotion::rests() const noexcept {
    return !has_now_ || (now_.ends_at_rest() && in_now_s_ >= seconds(now_) - rounding_s);
}

// A period on.
void TpMotion::follow(bool planned) noexcept {
    if (rests() && !planned && ring_count_ < ahead_) {
        return; // from standstill with a store: the first plan is the longest work
    }
    in_now_s_ += machine_.period_s;
    while (!has_now_ || in_now_s_ >= seconds(now_) - rounding_s) {
        if (ring_count_ == 0) {
            figures_.late += has_now_ && !now_.ends_at_rest() ? 1U : 0U;
            in_now_s_ = has_now_ ? seconds(now_) : 0.0;
            break;
        }
        in_now_s_ = has_now_ ? larger(in_now_s_ - seconds(now_), 0.0) : machine_.period_s;
        now_ = ring_[ring_head_];
        ring_head_ = (ring_head_ + 1U) % ring_size;
        --ring_count_;
        has_now_ = true;
    }
    if (has_now_) {
        at_ = place();
        if (backs()) {
            come_back_to(now_.waypoint, at_);
        } else {
            come_to(base_ + curve_.move_of(now_.waypoint), at_);
        }
    }
}

// Whether the machine has not passed the plane through the end of move n that halves the angle to the next one.
bool TpMotion::is_before_end(unsigned n, const Mm& at) noexcept {
    const QueuedMove& here = move(n);
    const QueuedMove& next = move(n + 1U);
    double along = 0.0;
    double past = 0.0;
    double straight = 1.0; // 0: back where it came from, so no plane halves the angle
    for (const unsigned k : indices(machine_.axes)) {
        const double way = at[k] - here.to[k];
        along += way * (here.out[k] + next.in[k]);
        past += way * here.out[k];
        straight += here.out[k] * next.in[k];
    }
    return (straight > turns_back ? along : past) < 0.0;
}

// The machine is on the piece of path that ends with move n.
void TpMotion::come_to(unsigned n, const Mm& at) noexcept {
    if (n != piece_) { // the piece before is over, and with it its move
        if (static_cast<int>(piece_ + 1U - floor_) > 0) {
            floor_ = piece_ + 1U;
        }
        piece_ = n;
    }
    for (unsigned i = 0; i < most_left && first_ != n && static_cast<int>(floor_ - first_) > 0; ++i) {
        ++first_;
    }
    for (unsigned i = 0; i<most_left&& static_cast<int>(n + 1U - first_)> 0 && pushed_ - first_ > 1U; ++i) {
        turn(at);
        const bool on_arc = move(first_).element.shape == MoveShape::arc;
        if (on_arc && turns_left_rad_ > half_turn_rad) {
            neared_ = first_ - 1U; // each turn passes that plane
            break;
        }
        if (is_before_end(first_, at)) {
            neared_ = first_;
            break;
        }
        if (on_arc && neared_ != first_) {
            break; // its start is behind that plane, too
        }
        ++first_;
    }
    turn(at);
}

// The squares of the lengths of X Y Z, of A B C, of U V W.
std::array<double, 3> TpMotion::ways_sq(const Mm& from, const Mm& to) const noexcept {
    std::array<double, 3> out{};
    for (const unsigned k : indices(machine_.axes)) {
        out[static_cast<unsigned>(machine_.axis[k]) / 3U] += (to[k] - from[k]) * (to[k] - from[k]);
    }
    return out;
}

// Of the newest move: the core's feed is that of X Y Z U V W together, so it is larger than that of X Y Z alone. Equal
// shares are equal feeds, whatever their last digits: a chain of lines has one feed.
double TpMotion::feed_mm(const QueuedMove& move) const noexcept {
    auto [xyz_sq, abc_sq, uvw_sq] = ways_sq(end_, move.to);
    xyz_sq = move.element.shape == MoveShape::arc ? move.length_mm * move.length_mm - abc_sq - uvw_sq : xyz_sq;
    const double beside = xyz_sq > 0.0 ? std::sqrt(1.0 + uvw_sq / xyz_sq) : 1.0;
    const double rounded = std::floor(beside * shares + 0.5) / shares;
    return xyz_sq > 0.0 || uvw_sq > 0.0 ? rounded * machine_.mm_per_unit : 1.0;
}

// What screens show of a way, in units.
double TpMotion::told_way(const Mm& from, const Mm& to) const noexcept {
    const auto [xyz_sq, abc_sq, uvw_sq] = ways_sq(from, to);
    const double linear_sq = xyz_sq > 0.0 ? xyz_sq : uvw_sq;
    return linear_sq > 0.0 ? std::sqrt(linear_sq) / machine_.mm_per_unit : std::sqrt(abc_sq);
}

void TpMotion::tell(const Mm& before, tpc_output& output) noexcept {
    Mm left{};
    const Mm& goal = !backs() ? move(first_).to : first_ == begun_ ? begun_at_ : move(first_ - 1U).to;
    for (const unsigned k : indices(machine_.axes)) {
        const double mm = scale(k);
        output.position[machine_.axis[k]] = at_[k] / mm;
        left[k] = first_ != last_ ? goal[k] - at_[k] : 0.0;
        output.to_go[machine_.axis[k]] = left[k] / mm;
    }
    output.speed = told_way(before, at_) / machine_.period_s;
    output.left = told_way(Mm{}, left);
    output.first = first_;
    output.pushed = pushed_;
    output.last = last_;
    const bool waits = state_ == State::between || state_ == State::path_waits || state_ == State::sync_waits;
    output.waits = waits ? 1 : 0;
    output.back_over = state_ == State::back_over || (brakes_ && !has_now_ && ring_count_ == 0) ? 1 : 0;
    output.error = error_;
    error_ = nullptr;
}

void TpMotion::run(const tpc_input& input, tpc_output& output) noexcept {
    const Mm before = at_;
    output.complete = 0;
    output.reverses = 0;
    output.in_step = 0;
    ++idle_;
    if (state_ >= State::sync_waits) {
        run_synced(input, output);
    } else if (state_ >= State::path) {
        brakes_ = turns_round(input.backward != 0);
        steer(input);
        follow(plan(input.may_begin != 0));
        const bool waits = state_ == State::path_waits;
        first_ = waits ? pushed_ : first_; // what is before it is over
        state_ = waits && !sent_abort_ && move(pushed_).pitch_mm > 0.0 ? State::between : state_;
        const bool aborted = sent_abort_ && stands() && stream_->activity() == Activity::aborted;
        const bool complete = pushed_ == last_ && has_now_ && at_known_end() && input.hold == 0;
        if (complete) {
            output.complete = 1;
            at_ = move(last_ - 1U).to; // to the last digit
        }
        if (aborted || complete) {
            forget();
        } else if (!sent_abort_ && !backs() && !brakes_) {
            output.in_step = step(input.steps != 0) ? 1 : 0;
        }
    } else if (input.abort != 0 || failed_) {
        forget();
    }
    tell(before, output);
}

} // namespace splinefeed::linuxcnc
