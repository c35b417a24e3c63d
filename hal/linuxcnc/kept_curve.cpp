// SPDX-License-Identifier: MIT
#include "kept_curve.hpp"

#include "splinefeed/number/vector.hpp"

#include <cmath>

namespace splinefeed::linuxcnc {

namespace {

constexpr unsigned looks = 64;      // places on a segment, to begin a search
constexpr unsigned most_steps = 8;  // of Newton, which doubles the digits
constexpr double same_mm = 1e-6;    // a place of the segment that is asked for
constexpr double nothing_mm = 1e-5; // of a segment that is left: the next one begins where the machine stands

/// The part of a polynomial from 0 to u, or from u to 1, by de Casteljau, in place.
void cut(PerDegree<double>& points, unsigned degree, double u, bool head) noexcept {
    for (unsigned r = 1; r <= degree; ++r) {
        for (unsigned i = r; i <= degree; ++i) {
            const unsigned k = head ? degree + r - i : i - r;
            double& point = points[k];
            point = head ? points[k - 1U] + u * (point - points[k - 1U]) : point + u * (points[k + 1U] - point);
        }
    }
}

struct Nearest {
    double u = 0.0;
    double distance_mm = largest<double>();
};

/// Of a segment, to a place at these offsets from its origin.
class PlaceSearch {
public:
    PlaceSearch(const CurveSegment<double>& segment, const PerAxis<Position>& at) noexcept : segment_(segment) {
        for (const unsigned k : indices(segment.axes)) {
            at_[k] = distance<double>(segment.origin[k], at[k], segment.unit_log2);
        }
    }
    [[nodiscard]] Nearest find() noexcept {
        Nearest out;
        for (unsigned i = 0; i <= looks; ++i) {
            keep_nearer(out, static_cast<double>(i) / looks);
        }
        for (unsigned i = 0; i < most_steps; ++i) {
            look(out.u);
            const double slope_sq = dot(slope_, slope_, segment_.axes);
            const double way = slope_sq > 0.0 ? dot(off_, slope_, segment_.axes) / slope_sq : 0.0;
            keep_nearer(out, smaller(larger(out.u - way, 0.0), 1.0));
        }
        out.distance_mm = scale2(out.distance_mm, segment_.unit_log2);
        return out;
    }

private:
    void look(double u) noexcept {
        const auto n = static_cast<unsigned>(segment_.degree);
        for (const unsigned k : indices(segment_.axes)) {
            PerDegree<double> points = segment_.control[k];
            cut(points, n, u, false);
            off_[k] = points[0] - at_[k];
            points = segment_.control[k];
            for (unsigned i = 0; i < n; ++i) {
                points[i] = points[i + 1U] - points[i];
            }
            cut(points, n - 1U, u, false);
            slope_[k] = n * points[0];
        }
    }
    void keep_nearer(Nearest& out, double u) noexcept {
        look(u);
        const double far = norm(off_, segment_.axes);
        out = far < out.distance_mm ? Nearest{u, far} : out;
    }

    const CurveSegment<double>& segment_;
    PerAxis<double> at_{};
    PerAxis<double> off_{};
    PerAxis<double> slope_{};
};

/// The length of the polygon of its points, from 0 to u or from u to 1.
double left_mm(const CurveSegment<double>& segment, double u, bool head) noexcept {
    PerAxis<PerDegree<double>> points = segment.control;
    for (const unsigned k : indices(segment.axes)) {
        cut(points[k], static_cast<unsigned>(segment.degree), u, head);
    }
    double length = 0.0;
    for (const unsigned i : indices(segment.degree)) {
        length += norm(leg(points, i, i + 1U, segment.axes), segment.axes);
    }
    return scale2(length, segment.unit_log2);
}

} // namespace

void KeptCurve::begin(CurveSource<double>& source) noexcept {
    source_ = &source;
    oldest_ = newest_ = next_ = 0;
    backward_ = leads_ = false;
}

// Also its neighbours: a place at an end of a segment belongs to both.
void KeptCurve::find(std::uint32_t on) noexcept {
    Nearest nearest{1.0, largest<double>()};
    next_ = on;
    for (const std::uint32_t n : {on, on - 1U, on + 1U}) {
        if (nearest.distance_mm > same_mm && n - oldest_ < newest_ - oldest_) {
            const Nearest found = PlaceSearch(kept(n), at_).find();
            if (found.distance_mm < nearest.distance_mm) {
                nearest = found;
                next_ = n;
            }
        }
    }
    cut_ = nearest.u;
}

void KeptCurve::turn(const PerAxis<Position>& at, std::uint32_t on, bool backward, std::uint32_t least_move) noexcept {
    at_ = at;
    backward_ = backward;
    leads_ = true;
    find(on);
    if (left_mm(kept(next_), cut_, backward) < nothing_mm) {
        next_ += backward ? ~0U : 1U;
        cut_ = backward ? 1.0 : 0.0;
    }
    std::uint32_t least = oldest_; // moves do not go back from one to the next
    for (std::uint32_t over = newest_ - oldest_; over > 0;) {
        const std::uint32_t half = over / 2U;
        const bool before = static_cast<std::int32_t>(move_of(least + half) - least_move) < 0;
        least += before ? half + 1U : 0U;
        over = before ? over - half - 1U : half;
    }
    last_back_ = least;
}

// From where the machine turned.
void KeptCurve::lead(CurveSegment<double>& out) noexcept {
    const auto n = static_cast<unsigned>(out.degree);
    PerAxis<PerDegree<double>> offsets{};
    for (const unsigned k : indices(out.axes)) {
        PerDegree<double>& points = out.control[k];
        cut(points, n, cut_, backward_);
        const auto at = distance<double>(out.origin[k], at_[k], out.unit_log2);
        for (unsigned i = 0; i <= n; ++i) {
            offsets[k][i] = scale2(points[i] - at, out.unit_log2 - chord_unit_log2);
        }
        offsets[k][backward_ ? n : 0U] = 0.0;
        out.origin[k] = at_[k];
    }
    out.assign(offsets);
    leads_ = false;
}

Pull KeptCurve::next(CurveSegment<double>& out) noexcept {
    if (!backward_ && next_ == newest_) {
        if (const Pull pull = source_->next(out); pull != Pull::item) {
            return pull;
        }
        kept_[newest_ % capacity] = out;
        ++newest_;
        oldest_ += newest_ - oldest_ > capacity ? 1U : 0U;
    } else if (backward_ && static_cast<std::int32_t>(next_ - last_back_) < 0) {
        return Pull::starved;
    } else {
        out = kept(next_);
    }
    if (leads_) {
        lead(out);
    }
    if (backward_) {
        const auto n = static_cast<unsigned>(out.degree);
        for (const unsigned k : indices(out.axes)) {
            out.end[k] = out.start(k);
            for (unsigned i = 0; 2U * i < n; ++i) {
                std::swap(out.control[k][i], out.control[k][n - i]);
            }
        }
        out.stop_at_end = next_ == last_back_ || kept(next_ - 1U).stop_at_end;
    }
    out.waypoint = next_;
    next_ += backward_ ? ~0U : 1U;
    return Pull::item;
}

} // namespace splinefeed::linuxcnc
