// SPDX-License-Identifier: MIT
#include "host_sim/analysis/path_strand.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {

constexpr double chord_mm = 1.0 / 4096.0;
static_assert(chord_unit_log2 == -12, "update chord_mm");
constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double part_of_arc = 0.1; // [rad]
constexpr int most_parts = 4096;
constexpr int parts_of_bezier = 24;
constexpr std::size_t block = 12;               // places
constexpr int most_looks = 40;                  // of a descent: most take four
constexpr double near_enough_sq = 1e-20;        // 0.1 pm: no nearer place can matter
constexpr double least_gain = 1e-10;            // of the square of the distance
constexpr double least_share_of_newton = 0.125; // of what Gauss and Newton divide by
constexpr int finer = 16;                       // parts for each one, where a few do not lead to the foot

} // namespace

PathStrand::PathStrand(const PerAxis<Position>& from, const PathElement<double>& move, int axes) : axes_(axes) {
    if (move.shape == MoveShape::bezier) {
        degree_ = move.bezier.degree;
        parts_ = parts_of_bezier;
        for (const unsigned k : indices(axes)) {
            for (unsigned i = 0; i <= static_cast<unsigned>(degree_); ++i) {
                control_[k][i] = to_mm(from[k]) + move.bezier.points[k][i] * chord_mm;
            }
        }
    }
    for (const unsigned k : indices(axes)) {
        control_[k][0] = to_mm(from[k]);
        control_[k][static_cast<unsigned>(degree_)] = to_mm(move.to[k]);
    }
    if (move.shape == MoveShape::arc) {
        arc_ = arc_of(from, move, axes);
        parts_ = std::clamp(static_cast<int>(std::fabs(arc_->angle()) / part_of_arc), 8, most_parts);
    }
    bound();
}

PathStrand::PathStrand(const CurveSegment<double>& segment, int detail) : axes_(segment.axes), degree_(segment.degree) {
    for (const unsigned k : indices(axes_)) {
        for (unsigned i = 0; i <= static_cast<unsigned>(degree_); ++i) {
            control_[k][i] = segment.control_mm(static_cast<int>(k), static_cast<int>(i));
        }
    }
    parts_ = degree_ == 1 ? 1 : std::min(parts_of_bezier + detail, most_parts);
    bound();
}

// Most strands are only compared with their boxes, or near places that are known.
void PathStrand::look_ahead() const {
    for (int i = 0; i <= parts_; ++i) {
        places_.push_back(at(i / static_cast<double>(parts_)));
    }
    for (std::size_t first = 0; first < places_.size(); first += block) {
        Box& box = blocks_.emplace_back(Box{places_[first], places_[first]});
        for (std::size_t i = first; i < std::min(first + block, places_.size()); ++i) {
            for (const unsigned k : indices(axes_)) {
                box.low[k] = std::min(box.low[k], places_[i][k]);
                box.high[k] = std::max(box.high[k], places_[i][k]);
            }
        }
    }
}

void PathStrand::bound() {
    for (const unsigned k : indices(axes_)) {
        const auto* const first = control_[k].begin();
        const auto [low, high] = std::minmax_element(first, first + degree_ + 1);
        box_.low[k] = *low;
        box_.high[k] = *high;
        if (arc_ && k < 3) {
            const double start = control_[k][0];
            box_.low[k] = start - arc_->extent(k);
            box_.high[k] = start + arc_->extent(k);
        }
    }
}

double PathStrand::radius() const noexcept {
    return arc_ ? std::fmax(arc_->radius_from(), arc_->radius_to()) : 0.0;
}

PerAxis<double> PathStrand::at(double t) const noexcept {
    PerAxis<double> out{};
    for (const unsigned k : indices(axes_)) {
        PerDegree<double> row = control_[k];
        for (int last = degree_; last > 0; --last) {
            for (const unsigned i : indices(last)) {
                row[i] += t * (row[i + 1] - row[i]);
            }
        }
        out[k] = row[0];
    }
    if (arc_) {
        const CurveState state = arc_->at(t);
        for (unsigned k = 0; k < 3 && k < static_cast<unsigned>(axes_); ++k) {
            out[k] = state.point[k];
        }
    }
    return out;
}

// Of an axis by De Casteljau's rows: the derivatives are in the last two before the point.
PathStrand::State PathStrand::state(double t) const noexcept {
    State out;
    for (const unsigned k : indices(axes_)) {
        PerDegree<double> row = control_[k];
        for (int last = degree_; last > 0; --last) {
            if (last == 2) {
                out.second[k] = degree_ * (degree_ - 1) * (row[2] - 2.0 * row[1] + row[0]);
            } else if (last == 1) {
                out.first[k] = degree_ * (row[1] - row[0]);
            }
            for (const unsigned i : indices(last)) {
                row[i] += t * (row[i + 1] - row[i]);
            }
        }
        out.point[k] = row[0];
    }
    if (arc_) {
        const CurveState turned = arc_->at(t);
        for (unsigned k = 0; k < 3 && k < static_cast<unsigned>(axes_); ++k) {
            out.point[k] = turned.point[k];
            out.first[k] = turned.first[k];
            out.second[k] = turned.second[k];
        }
    }
    return out;
}

double distance_sq(const PerAxis<double>& a, const PerAxis<double>& b, const AxisSet& set) noexcept {
    return sum_of(set.count, [&](unsigned n) {
        const double apart = a[set.axis[n]] - b[set.axis[n]];
        return apart * apart;
    });
}

double distance_from_line(const PerAxis<double>& point, const PerAxis<double>& from, const PerAxis<double>& to,
                          const AxisSet& set) noexcept {
    double along = 0.0;
    double length_sq = 0.0;
    for (const unsigned n : indices(set.count)) {
        const unsigned k = set.axis[n];
        const double way = to[k] - from[k];
        along += (point[k] - from[k]) * way;
        length_sq += way * way;
    }
    const double t = length_sq > 0.0 ? std::clamp(along / length_sq, 0.0, 1.0) : 0.0;
    return std::sqrt(sum_of(set.count, [&](unsigned n) {
        const unsigned k = set.axis[n];
        const double apart = from[k] + t * (to[k] - from[k]) - point[k];
        return apart * apart;
    }));
}

double PathStrand::distance_sq(const PerAxis<double>& point, const AxisSet& set, double t) const noexcept {
    return host::distance_sq(at(t), point, set);
}

double PathStrand::Box::distance_sq(const PerAxis<double>& point, const AxisSet& set) const noexcept {
    double sum = 0.0;
    for (const unsigned n : indices(set.count)) {
        const unsigned k = set.axis[n];
        const double apart = std::max(0.0, std::max(low[k] - point[k], point[k] - high[k]));
        sum += apart * apart;
    }
    return sum;
}

// The nearest of the places.
PathStrand::Foot PathStrand::guess(const PerAxis<double>& point, const AxisSet& set) const {
    if (places_.empty()) {
        look_ahead();
    }
    std::size_t nearest = 0;
    double best_sq = 1e300;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        if (blocks_[b].distance_sq(point, set) >= best_sq) {
            continue;
        }
        for (std::size_t i = b * block; i < std::min((b + 1) * block, places_.size()); ++i) {
            const double sum = host::distance_sq(places_[i], point, set);
            if (sum < best_sq) {
                best_sq = sum;
                nearest = i;
            }
        }
    }
    return {static_cast<double>(nearest) / static_cast<double>(parts_), best_sq};
}

// The nearest of its ends and of the places in the direction of the point, in the turns that radius, height and the
// other axes tell. Each counts by its square, as in the distance: a rise of rounding says nothing beside another one.
PathStrand::Foot PathStrand::guess_on_arc(const PerAxis<double>& point, const AxisSet& set) const noexcept {
    const ProgrammedArc::Cylindrical polar = arc_->polar({point[0], point[1], point[2]});
    const double growth = arc_->radius_to() - arc_->radius_from();
    double along = growth * polar.growth + arc_->rise() * polar.rise;
    double way_sq = growth * growth + arc_->rise() * arc_->rise();
    for (const unsigned n : indices(set.count)) {
        const unsigned k = set.axis[n];
        if (k >= 3) {
            const double way = control_[k][static_cast<unsigned>(degree_)] - control_[k][0];
            along += way * (point[k] - control_[k][0]);
            way_sq += way * way;
        }
    }
    const double share = way_sq > 0.0 ? std::clamp(along / way_sq, 0.0, 1.0) : 0.0;
    const double turn = two_pi / std::fabs(arc_->angle());
    const double first = std::fmod(std::fmod(polar.angle / arc_->angle(), turn) + turn, turn); // of the first turn
    const double turns = std::clamp(std::round((share - first) / turn), 0.0, std::floor(1.0 / turn));
    Foot best{0.0, distance_sq(point, set, 0.0)};
    for (const double t : {1.0, first + (turns - 1.0) * turn, first + turns * turn, first + (turns + 1.0) * turn}) {
        if (t >= 0.0 && t <= 1.0) {
            const double there = distance_sq(point, set, t);
            best = there < best.distance_sq ? Foot{t, there} : best;
        }
    }
    return best;
}

// From a place downhill: by Newton's step where the distance is convex, else by that of Gauss and Newton. A step that
// does not come nearer is halved, so the cost is bounded and no step leads away.
PathStrand::Foot PathStrand::descend(Foot foot, const PerAxis<double>& point, const AxisSet& set,
                                     double enough_sq) const noexcept {
    double change = 0.0;
    double t = foot.t;
    for (int look = 0; look < most_looks; ++look) {
        const State there = state(t);
        double apart_sq = 0.0;
        double way = 0.0;
        double speed_sq = 0.0;
        double bend = 0.0;
        for (const unsigned n : indices(set.count)) {
            const unsigned k = set.axis[n];
            const double apart = point[k] - there.point[k];
            apart_sq += apart * apart;
            way += apart * there.first[k];
            speed_sq += there.first[k] * there.first[k];
            bend += apart * there.second[k];
        }
        if (look > 0 && !(apart_sq < foot.distance_sq)) {
            change *= 0.5;
        } else {
            foot = {t, apart_sq};
            const double newton = speed_sq - bend;
            const double divisor = newton > least_share_of_newton * speed_sq ? newton : speed_sq;
            if (apart_sq <= enough_sq || !(way * way > least_gain * apart_sq * divisor)) {
                return foot;
            }
            change = std::clamp(t + way / divisor, 0.0, 1.0) - t;
        }
        t = foot.t + change;
        if (t == foot.t) {
            return foot;
        }
    }
    return foot;
}

// From each of many places that is nearer than those beside it: where the strand has a cusp or comes back, the nearest
// of a few need not lead to the foot.
PathStrand::Foot PathStrand::search(Foot best, const PerAxis<double>& point, const AxisSet& set) const noexcept {
    const int count = parts_ * finer;
    double before = 1e300;
    double here = distance_sq(point, set, 0.0);
    for (int i = 0; i <= count; ++i) {
        const double next = i < count ? distance_sq(point, set, (i + 1) / static_cast<double>(count)) : 1e300;
        if (here <= before && here <= next) {
            const Foot foot = descend({i / static_cast<double>(count), here}, point, set, near_enough_sq);
            best = foot.distance_sq < best.distance_sq ? foot : best;
        }
        before = here;
        here = next;
    }
    return best;
}

double PathStrand::distance_downhill(const PerAxis<double>& point, const AxisSet& set, double enough,
                                     double& t) const noexcept {
    if (straight()) {
        return distance_from_line(point, control_at(control_, 0, axes_),
                                  control_at(control_, static_cast<unsigned>(degree_), axes_), set);
    }
    const Foot foot = descend({t, 0.0}, point, set, enough * enough);
    t = foot.t;
    return std::sqrt(foot.distance_sq);
}

// An eighth of the square of the part times the largest second derivative, which is not above that of the polygon.
double PathStrand::bow(const AxisSet& set, double part) const noexcept {
    double most_sq = 0.0;
    for (unsigned i = 2; i <= static_cast<unsigned>(degree_); ++i) {
        most_sq = std::max(most_sq, sum_of(set.count, [&](unsigned n) {
                               const PerDegree<double>& c = control_[set.axis[n]];
                               const double bend = c[i] - 2.0 * c[i - 1] + c[i - 2];
                               return bend * bend;
                           }));
    }
    return 0.125 * part * part * degree_ * (degree_ - 1) * std::sqrt(most_sq);
}

double PathStrand::distance(const PerAxis<double>& point, const AxisSet& set, double enough) const noexcept {
    const bool turns = arc_ && set.axis[0] < 3;
    if (!turns && (degree_ == 1 || arc_)) {
        return distance_from_line(point, control_at(control_, 0, axes_),
                                  control_at(control_, static_cast<unsigned>(degree_), axes_), set);
    }
    Foot foot = descend(turns ? guess_on_arc(point, set) : guess(point, set), point, set, near_enough_sq);
    if (!turns && foot.distance_sq > std::fmax(enough * enough, near_enough_sq)) {
        foot = search(foot, point, set);
    }
    return std::sqrt(foot.distance_sq);
}

} // namespace splinefeed::host
