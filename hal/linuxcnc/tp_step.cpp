// SPDX-License-Identifier: MIT
//
// Single step: each move ends on its end, at standstill.
//
// While it is on, a path is one move. What was joined before is taken apart where the machine stands: what is left of
// the move under way begins there, and all that is queued behind it is as it came. Behind single step, moves are joined
// again in the same way.
#include "tp_motion.hpp"

#include "splinefeed/number/vector.hpp"

#include <cmath>

namespace splinefeed::linuxcnc {

namespace {

constexpr double whole_turn_rad = 6.283185307179586;
constexpr double no_turn_rad = 1e-6;
constexpr double most_off = 1.0 / 32.0; // of the radius: the core takes a sixteenth

} // namespace

// From there to the end of the arc under way, in its direction, within half a turn.
double TpMotion::turned_to_end(const Mm& at) noexcept {
    const QueuedMove& here = move(first_);
    const auto& n = here.element.arc.normal;
    std::array<double, 3> a{};
    std::array<double, 3> b{};
    double a_n = 0.0;
    double b_n = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        a[k] = at[k] - to_mm(here.element.arc.centre[k]);
        b[k] = here.to[k] - to_mm(here.element.arc.centre[k]);
        a_n += a[k] * n[k];
        b_n += b[k] * n[k];
    }
    double sine = 0.0;
    double cosine = -a_n * b_n;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned i = (k + 1) % 3;
        const unsigned j = (k + 2) % 3;
        sine += n[k] * (a[i] * b[j] - a[j] * b[i]);
        cosine += a[k] * b[k];
    }
    return std::atan2(here.element.arc.sweep_rad < 0.0 ? -sine : sine, cosine);
}

// A period on: how far the arc under way has to turn. A place alone does not tell whole turns.
void TpMotion::turn(const Mm& at) noexcept {
    const PathElement<double>& here = move(first_).element;
    if (first_ == last_ || here.shape != MoveShape::arc) {
        return;
    }
    const double left = turning_ == first_ ? turns_left_rad_ : std::fabs(here.arc.sweep_rad);
    const double seen = turned_to_end(at);
    turns_left_rad_ = seen + whole_turn_rad * std::floor((left - seen) / whole_turn_rad + 0.5);
    turning_ = first_;
}

// At standstill: what is left of the move under way is a move from here.
void TpMotion::take_apart() noexcept {
    const bool begun = pushed_ != first_;
    pushed_ = first_;
    leave_path();
    if (!begun) {
        return;
    }
    turn(at_);
    QueuedMove& rest = move(first_);
    Mm from = at_;
    if (rest.element.shape == MoveShape::arc &&
        turns_left_rad_ <= no_turn_rad) { // at its end, or beyond it in a rounded corner
        rest.element.shape = MoveShape::line;
    } else if (rest.element.shape == MoveShape::arc) {
        rest.element.arc.sweep_rad = std::copysign(turns_left_rad_, rest.element.arc.sweep_rad);
        const auto arm = [&](const Mm& at, std::array<double, 3>& radial) {
            double height = 0.0;
            for (unsigned k = 0; k < 3; ++k) {
                radial[k] = at[k] - to_mm(rest.element.arc.centre[k]);
                height += radial[k] * rest.element.arc.normal[k];
            }
            double length_sq = 0.0;
            for (unsigned k = 0; k < 3; ++k) {
                radial[k] -= height * rest.element.arc.normal[k];
                length_sq += radial[k] * radial[k];
            }
            return std::sqrt(length_sq);
        };
        std::array<double, 3> radial{};
        const double radius = arm(rest.to, radial);
        const double here = arm(at_, radial);
        state_ = std::fabs(here - radius) > most_off * radius ? State::leads : state_;
        for (unsigned k = 0; state_ == State::leads && k < 3; ++k) {
            from[k] += radial[k] * (radius / here - 1.0);
        }
        lead_to_ = from;
    }
    if (measure(from, rest) == -1) { // nothing is left, so it stays there, within 0.1 um
        pushed_ = ++first_;
    }
    if (first_ == last_) {
        forget();
    }
}

// A path begins with a line to the arc, where the machine stands too far from it: in a rounded corner.
Status TpMotion::lead() noexcept {
    QueuedMove& arc = move(first_);
    arc.stands_before = false;
    PathElement<double> line = arc.element;
    line.shape = MoveShape::line;
    line.to = position_from_mm(lead_to_, machine_.axes);
    base_ = pushed_ - 1U;
    const Result<bool> taken = stream_->push(line);
    return taken.has_value() ? Status{} : taken.error();
}

// Behind a period. @return whether a step is under way
bool TpMotion::step(bool steps) noexcept {
    const bool at_end = at_known_end();
    if (stepped_ && at_end && pushed_ != first_ && pushed_ != last_) {
        at_ = move(first_).to; // to the last digit
        first_ = pushed_;
        leave_path();
        return false;
    }
    if (stepped_ != steps && stands() && !(at_end && pushed_ == last_)) {
        take_apart();
    }
    return steps;
}

} // namespace splinefeed::linuxcnc
