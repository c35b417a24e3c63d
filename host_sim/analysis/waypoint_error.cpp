// SPDX-License-Identifier: MIT
//
// Nearest point of a Bezier segment: the best of a few equidistant ones, then Newton's method for the root of
// (C - P) . C' with the step halved until the distance falls. For a curve that passes its waypoint, the end of the
// segment is that best one, and two steps reach the last bit; for one that only approaches it (control points), the
// result is never below the true distance.
#include "host_sim/analysis/waypoint_error.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splinefeed::host {

namespace {

constexpr int start_points = 8;
constexpr int newton_steps = 12;
constexpr double merge_mm = 1e-6; // nearer waypoints are one to the curve (WaypointCurve::push)

struct Derivatives {
    double value = 0.0;
    double first = 0.0;
    double second = 0.0;
};

// De Casteljau; the last three levels give the derivatives.
Derivatives derivatives_at(PerDegree<double> b, int degree, double u) noexcept {
    Derivatives out;
    const auto n = static_cast<unsigned>(degree);
    for (unsigned level = n; level > 0; --level) {
        if (level == 2) {
            out.second = degree * (degree - 1) * (b[2] - 2.0 * b[1] + b[0]);
        }
        if (level == 1) {
            out.first = degree * (b[1] - b[0]);
        }
        for (unsigned i = 0; i < level; ++i) {
            b[i] += u * (b[i + 1] - b[i]);
        }
    }
    out.value = b[0];
    return out;
}

struct Approach {
    double distance_sq = 0.0;
    double slope = 0.0;     // (C - P) . C'
    double curvature = 0.0; // its derivative; of Gauss-Newton where that is not positive
};

// Whether an index comes before another one; they wrap.
bool comes_before(std::uint32_t index, std::uint32_t other) {
    return static_cast<std::int32_t>(index - other) < 0;
}

} // namespace

double WaypointError::Piece::distance_mm(const PerAxis<Position>& position) const noexcept {
    const PerAxis<double> target = distances<double>(origin, position, 0, axes); // exact before it is rounded
    const auto approach = [&](double u) noexcept {
        Approach at;
        double tangent_sq = 0.0;
        for (const unsigned k : indices(axes)) {
            const Derivatives axis = derivatives_at(offset[k], degree, u);
            const double miss = axis.value - target[k];
            at.distance_sq += miss * miss;
            at.slope += miss * axis.first;
            at.curvature += miss * axis.second;
            tangent_sq += axis.first * axis.first;
        }
        at.curvature = at.curvature + tangent_sq > 0.0 ? at.curvature + tangent_sq : tangent_sq;
        return at;
    };
    double u = 0.0;
    Approach best{std::numeric_limits<double>::infinity(), 0.0, 0.0};
    for (int i = 0; i <= start_points; ++i) {
        const double v = static_cast<double>(i) / start_points;
        const Approach at = approach(v);
        if (at.distance_sq < best.distance_sq) {
            best = at;
            u = v;
        }
    }
    for (int i = 0; i < newton_steps && best.curvature > 0.0; ++i) {
        double step = -best.slope / best.curvature;
        Approach at = best;
        double v = u;
        for (int halving = 0; halving < 6; ++halving, step *= 0.5) {
            v = std::clamp(u + step, 0.0, 1.0);
            at = approach(v);
            if (at.distance_sq < best.distance_sq) {
                break;
            }
        }
        if (!(at.distance_sq < best.distance_sq)) {
            break;
        }
        best = at;
        u = v;
    }
    return std::sqrt(best.distance_sq);
}

void WaypointError::waypoint(std::uint32_t index, const PerAxis<Position>& position) {
    if (!pending_.empty()) {
        Pending& before = pending_.back();
        double largest = 0.0;
        double sum_sq = 0.0;
        for (unsigned k = 0; k < position.size(); ++k) {
            const double apart = to_mm(Position{position[k].raw - before.position[k].raw});
            largest = std::max(largest, std::fabs(apart));
            sum_sq += apart * apart;
        }
        if (largest < merge_mm) {
            before.merged_mm = std::max(before.merged_mm, std::sqrt(sum_sq));
            return;
        }
    }
    pending_.push_back({index, position, 0.0});
}

void WaypointError::segment(const CurveSegment<double>& segment) {
    Piece piece;
    piece.axes = segment.axes;
    piece.degree = segment.degree;
    piece.origin = segment.origin;
    for (const unsigned k : indices(segment.axes)) {
        for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
            piece.offset[k][i] = scale2(segment.control[k][i], segment.unit_log2);
        }
    }
    advance(piece, segment.waypoint);
}

void WaypointError::advance(const Piece& piece, std::uint32_t waypoint) {
    while (!pending_.empty() && comes_before(pending_.front().index, waypoint)) {
        const Pending& passed = pending_.front();
        double distance = piece.distance_mm(passed.position);
        if (any_segment_) {
            distance = std::min(distance, last_.distance_mm(passed.position));
        }
        largest_mm_ = std::max(largest_mm_, distance + passed.merged_mm);
        pending_.pop_front();
    }
    last_ = piece;
    last_waypoint_ = waypoint;
    any_segment_ = true;
}

double WaypointError::largest_mm() const noexcept {
    if (!any_segment_ || pending_.empty() || comes_before(last_waypoint_, pending_.front().index)) {
        return largest_mm_;
    }
    // The last one reached waits for the segment after it, which may come nearer.
    return std::max(largest_mm_, last_.distance_mm(pending_.front().position) + pending_.front().merged_mm);
}

} // namespace splinefeed::host
