// SPDX-License-Identifier: MIT
#include "host_sim/analysis/path_deviation.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double arc_error = 9e-8;       // of a quintic of 0.4 rad, as a part of the radius
constexpr double least_growth_mm = 4e-6; // of the radius of a spiral
constexpr double any_distance = 1e150;
constexpr double left_out_below_mm = 2e-4; // on every axis: waypoints merge within half of it, and ends add up
constexpr int parts_of_line = 4;
constexpr int parts_a_move = 4; // of a segment through several
constexpr std::size_t halves_of_blend = 2;
constexpr int searches = 24; // of the golden section: 1e-5 of a part
constexpr double golden = 0.6180339887498949;
constexpr double rounding_mm = 1e-9; // of distances that are compared, and more
constexpr double chords_a_bow =
    64.0; // of a segment, squared, where its bow is as large as the distance: theirs is a 64th
constexpr double peak_over_sample = 1.5; // at most, of a distance between the looks at a segment

/// The argument between low and high where `value` is largest, if it has one maximum there.
template <class Value>
double argument_of_largest(double low, double high, const Value& value) {
    double a = high - golden * (high - low);
    double b = low + golden * (high - low);
    double at_a = value(a);
    double at_b = value(b);
    for (int i = 0; i < searches; ++i) {
        if (at_a > at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = value(a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = value(b);
        }
    }
    return 0.5 * (low + high);
}

// Quintics that turn by 0.4 rad. Those of spirals are shorter: they need no more than the slack.
double circle_error(const ProgrammedArc& arc) noexcept {
    const double growth = std::fabs(arc.radius_to() - arc.radius_from());
    return growth < least_growth_mm ? arc_error * std::fmax(arc.radius_from(), arc.radius_to()) : 0.0;
}

} // namespace

PathDeviation::PathDeviation(const MachineSettings& settings, double joint_mm, double rounding)
    : axes_(settings.axes), joint_mm_(joint_mm), rounding_(rounding) {
    for (const unsigned k : indices(axes_)) {
        AxisSet& set = sets_[settings.axis[k].rotary ? 1 : 0];
        set.axis[static_cast<unsigned>(set.count++)] = k;
    }
}

void PathDeviation::start(const PerAxis<Position>& position) {
    here_ = whole_end_ = position;
    reached_mm_ = to_mm(position, axes_);
}

void PathDeviation::stop() {
    if (!moves_.empty()) {
        moves_.back().mode = PathMode::exact_stop;
    }
}

void PathDeviation::move(const PathElement<double>& move, std::uint64_t line) {
    Move added{.strand = PathStrand(here_, move, axes_),
               .mode = move.stop_at_end ? PathMode::exact_stop : move.mode,
               .tolerance = move.tolerance_mm,
               .line = line};
    if (const auto& arc = added.strand.arc()) {
        added.rounding = circle_error(*arc);
    }
    const double largest = largest_size(distances<double>(here_, move.to, 0, axes_), axes_);
    const PerAxis<double> apart = distances<double>(whole_end_, move.to, 0, axes_);
    added.rounding += rounding_ * std::fmax(largest, added.strand.radius());
    if (move.shape != MoveShape::arc && largest_size(apart, axes_) < left_out_below_mm) {
        leave_out(added, std::sqrt(dot(apart, apart, axes_)));
    } else {
        join(added);
        whole_end_ = move.to;
    }
    moves_.push_back(std::move(added));
    here_ = move.to;
}

// The path need not have a move that is as short as rounding; the moves beside it may begin and end beside it.
void PathDeviation::leave_out(Move& move, double apart) {
    left_out_ = std::fmax(left_out_, apart);
    move.rounding += apart;
    if (last_whole_ >= oldest_ && last_whole_ - oldest_ < moves_.size()) {
        Move& before = moves_[last_whole_ - oldest_];
        before.rounding += apart;
        before.mode = move.mode == PathMode::exact_stop ? move.mode : before.mode;
        move.rounding = std::fmax(move.rounding, before.rounding);
        move.start_joint = before.start_joint;
    }
}

// The joint of the move and the one before it that is not negligible.
void PathDeviation::join(Move& move) {
    move.rounding += left_out_;
    left_out_ = 0.0;
    const std::uint64_t index = oldest_ + moves_.size();
    if (last_whole_ >= oldest_ && last_whole_ < index) {
        move.start_joint = allowed_at_joint(of(last_whole_), move);
        for (std::uint64_t i = last_whole_; i < index; ++i) {
            moves_[i - oldest_].end_joint = move.start_joint;
        }
    }
    last_whole_ = index;
}

double PathDeviation::allowed_at_joint(const Move& before, const Move& after) const noexcept {
    const double both = std::fmin(before.tolerance, after.tolerance);
    return before.mode == PathMode::exact_stop                 ? 0.0
           : before.mode == PathMode::continuous && both > 0.0 ? both
                                                               : joint_mm_;
}

double PathDeviation::allowed(std::uint64_t index) const noexcept {
    const Move& move = of(index);
    return std::fmax(move.start_joint, move.end_joint) + slack_mm + move.rounding;
}

// With a search for a nearer place only where the quick look says that the path is too far.
PathDeviation::Found PathDeviation::from_moves(const PerAxis<double>& point, const AxisSet& set, const Segment& among,
                                               std::uint64_t hint) const {
    const Found quick = from_moves(point, set, among, hint, Look::quick);
    return quick.distance <= quick.allowed ? quick : from_moves(point, set, among, quick.move, Look::thorough);
}

// @param hint  a move that is probably near
PathDeviation::Found PathDeviation::from_moves(const PerAxis<double>& point, const AxisSet& set, const Segment& among,
                                               std::uint64_t hint, Look look) const {
    Found best;
    double least_excess = any_distance;
    const auto look_at = [&](std::uint64_t i) {
        const PathStrand& strand = of(i).strand;
        const double permitted = allowed(i);
        const double worth = std::fmax(best.distance, least_excess + permitted);
        if (worth <= 0.0 || strand.at_least_sq(point, set) >= worth * worth) {
            return;
        }
        const double distance = strand.distance(point, set, look == Look::quick ? any_distance : permitted);
        if (distance < best.distance) {
            best.distance = distance;
            best.move = i;
        }
        least_excess = std::fmin(least_excess, distance - permitted);
    };
    look_at(hint);
    for (std::uint64_t i = among.first; i <= among.last; ++i) {
        look_at(i);
    }
    best.allowed = best.distance - least_excess; // a move further away may forgive more
    return best;
}

// Where no segment follows the move, the path stands.
double PathDeviation::from_segments(const PerAxis<double>& point, const AxisSet& set, std::uint64_t move) const {
    const auto nearest = [&](double best, double enough) {
        for (const Segment& segment : segments_) {
            if (segment.first <= move && move <= segment.last && segment.strand.at_least_sq(point, set) < best * best) {
                best = std::fmin(best, segment.strand.distance(point, set, enough));
            }
        }
        return best;
    };
    double best = nearest(any_distance, any_distance);
    if (best > allowed(move)) {
        best = nearest(best, allowed(move));
    }
    if (best < any_distance) {
        return best;
    }
    return std::sqrt(distance_sq(reached_mm_, point, set));
}

void PathDeviation::found(unsigned set, const Found& found) {
    const Place place{found.distance, found.move, of(found.move).line};
    if (set == 0 && listener_) {
        listener_(found.move, found.distance);
    }
    if (found.distance > largest_[set].distance) {
        largest_[set] = place;
    }
    const double over = found.distance - found.allowed;
    if (over > 0.0 && !(excess_ && excess_->place.distance - excess_->allowed >= over)) {
        excess_ = Excess{place, found.allowed, set == 1};
    }
}

// A distance of a place from a move that changes nothing: it is neither too large nor larger than the largest one.
double PathDeviation::harmless(unsigned set, std::uint64_t move) const noexcept {
    return listener_ ? -1.0 : std::fmin(largest_[set].distance, allowed(move)) - rounding_mm;
}

// Whether all its distances from straight moves are. A distance from a line is convex: on a chord of the segment it is
// that of an end at most. Where the nearest move is another one at the end, the chord is divided beside their joint.
bool PathDeviation::is_harmless(const Segment& segment, unsigned s) const noexcept {
    const AxisSet& set = sets_[s];
    const double most = harmless(s, segment.last);
    if (!(most > 0.0)) {
        return false;
    }
    const double whole = segment.strand.bow(set, 1.0);
    const auto parts =
        static_cast<int>(std::fmin(1.0 + std::sqrt(chords_a_bow * whole / most), segment.strand.parts()));
    const double bow = whole / (parts * parts);
    std::uint64_t near = segment.first;
    PerAxis<double> before = segment.strand.at(0.0);
    const auto is_near = [&](std::uint64_t move, const PerAxis<double>& place) {
        double anywhere = 0.0;
        return of(move).strand.straight() &&
               of(move).strand.distance_downhill(place, set, 0.0, anywhere) + bow <= harmless(s, move);
    };
    while (!is_near(near, before)) {
        if (near++ == segment.last) {
            return false;
        }
    }
    for (int i = 1; i <= parts; ++i) {
        const PerAxis<double> here = segment.strand.at(i / static_cast<double>(parts));
        while (!is_near(near, here)) {
            const PerAxis<double> joint = of(near).strand.at(1.0);
            const double apart = distance_from_line(joint, before, here, set) + bow;
            if (near++ == segment.last || !of(near).strand.straight() ||
                !(apart <= std::fmin(harmless(s, near - 1), harmless(s, near)))) {
                return false;
            }
        }
        before = here;
    }
    return true;
}

// The same of a place of a move and the segments that may follow it.
bool PathDeviation::is_harmless(const PerAxis<double>& point, unsigned s, std::uint64_t move) noexcept {
    const double enough = harmless(s, move);
    return enough > 0.0 && std::ranges::any_of(segments_, [&](Segment& segment) {
               return segment.first <= move && move <= segment.last &&
                      segment.strand.at_least_sq(point, sets_[s]) <= enough * enough &&
                      segment.strand.distance_downhill(point, sets_[s], enough, segment.foot) <= enough;
           });
}

void PathDeviation::measure_segment(const Segment& segment) {
    const int parts = segment.strand.straight() ? 2 : segment.strand.parts();
    for (unsigned s = 0; s < sets_.size(); ++s) {
        if (sets_[s].count == 0 || is_harmless(segment, s)) {
            continue;
        }
        std::uint64_t near = segment.first;
        const auto at = [&](double t) {
            const Found here = from_moves(segment.strand.at(t), sets_[s], segment, near);
            near = here.move;
            return here;
        };
        int worst = 0;
        Found largest{-1.0, 0.0, 0};
        for (int i = 0; i <= parts; ++i) {
            const Found here = at(i / static_cast<double>(parts));
            found(s, here);
            if (here.distance > largest.distance) {
                largest = here;
                worst = i;
            }
        }
        // A distance that can be neither the largest one nor too large need not be found to the last digit.
        const double matters = listener_ ? 0.0 : std::fmin(largest_[s].distance, largest.allowed);
        if (largest.distance > slack_mm && largest.distance * peak_over_sample >= matters) {
            const double t = argument_of_largest(std::max(worst - 1, 0) / static_cast<double>(parts),
                                                 std::min(worst + 1, parts) / static_cast<double>(parts),
                                                 [&](double u) { return at(u).distance; });
            found(s, at(t));
        }
    }
}

void PathDeviation::measure_move(std::uint64_t index) {
    const PathStrand& strand = of(index).strand;
    const int parts = strand.straight() ? parts_of_line : strand.parts();
    for (unsigned s = 0; s < sets_.size(); ++s) {
        for (int i = index == 0 ? 0 : 1; i <= parts && sets_[s].count > 0; ++i) {
            const PerAxis<double> place = strand.at(i / static_cast<double>(parts));
            if (!is_harmless(place, s, index)) {
                found(s, {from_segments(place, sets_[s], index), allowed(index), index});
            }
        }
    }
}

// Moves that no later segment follows.
void PathDeviation::measure_moves_before(std::uint64_t end) {
    for (; measured_ < end && measured_ < oldest_ + moves_.size(); ++measured_) {
        measure_move(measured_);
        if (measured_ > oldest_) {
            moves_.pop_front();
            ++oldest_;
        }
    }
    while (!segments_.empty() && segments_.front().last < measured_) {
        segments_.pop_front();
    }
}

// The last segments but some reach into the moves up to `last` at most.
void PathDeviation::accept(std::size_t kept, std::uint64_t last) {
    while (pending_.size() > kept) {
        pending_.front().last = last;
        segments_.push_back(std::move(pending_.front()));
        pending_.pop_front();
        reached_mm_ = segments_.back().strand.at(1.0);
        measure_segment(segments_.back());
    }
}

void PathDeviation::segment(const CurveSegment<double>& segment) {
    const std::uint64_t known = oldest_ + moves_.size();
    if (known == 0) {
        return;
    }
    const auto back = static_cast<std::uint32_t>(static_cast<std::uint32_t>(known - 1) - segment.waypoint);
    const std::uint64_t index = known - 1 - back;
    accept(index == run_ ? halves_of_blend - 1 : 0, std::max(index, run_));
    if (index != run_) {
        measure_moves_before(run_);
        run_before_ = std::max(run_, oldest_);
        run_ = index;
    }
    const std::uint64_t first = std::min(run_before_, index);
    const int detail = static_cast<int>(std::min<std::uint64_t>(index - first, 256)) * parts_a_move;
    pending_.push_back({PathStrand(segment, detail), first, index});
}

void PathDeviation::finish() {
    accept(0, oldest_ + moves_.size() - 1);
    measure_moves_before(oldest_ + moves_.size());
}

std::string describe(const PathDeviation::Excess& excess, const std::string& name) {
    const char* const unit = excess.rotary ? "degrees" : "mm";
    return fmt::format("the path is {:.9g} {} from {}; its tolerance allows {:.9g} {}", excess.place.distance, unit,
                       name, excess.allowed, unit);
}

} // namespace splinefeed::host
