// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/bspline_curve.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

// Whether the segment that starts at vertex `at` is travelled. On a closed curve each side (degree 3 and 1) and each
// corner (degree 2) is travelled once, between the two passages of the seam.
template <Scalar S>
bool BSplineCurve<S>::wanted(std::uint64_t at, int degree) const noexcept {
    return this->travelled(degree == 1 ? at : at + 1);
}

// Writes the segment that starts at vertex next_. `end` is the last vertex of the run, or any vertex beyond those that
// matter.
template <Scalar S>
void BSplineCurve<S>::emit(std::uint64_t end, int degree, CurveSegment<S>& out) const noexcept {
    const std::uint64_t at = next_;
    const bool last = at + static_cast<std::uint64_t>(degree) == end;
    const std::uint64_t origin = degree == 1 ? at : at + 1;
    this->describe_segment(origin, degree, out);
    const Knot<S>& leads_to = this->knot(last ? end : degree == 2 ? at + 1 : origin + 1);
    out.end = leads_to.position;
    out.feed_mm_s = leads_to.feed_mm_s;
    out.max_feed_mm_s = leads_to.max_feed_mm_s;
    out.stop_at_end = last;
    out.waypoint = leads_to.waypoint;
    BoehmPoints<S> points{};
    const PerAxis<S>& side = this->knot(at).chord;
    if (degree == 1) {
        points[1] = side;
    } else if (degree == 2) {
        boehm_quadratic(side, this->knot(at + 1).chord, at == first_, last, points);
    } else {
        const auto pieces = static_cast<std::int64_t>(end - first_) - 2;
        boehm_cubic(side, this->knot(at + 1).chord, this->knot(at + 2).chord,
                    SideParts::of_open(static_cast<std::int64_t>(at - first_), pieces), points);
    }
    PerAxis<PerDegree<S>> offsets{};
    for (const unsigned k : indices(this->axes())) {
        for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
            offsets[k][i] = points[i][k];
        }
        if (!last) { // the joint: a closed curve may end there
            out.end[k] = displaced(out.origin[k], offsets[k][static_cast<unsigned>(degree)], chord_unit_log2);
        }
    }
    out.assign(offsets);
}

template <Scalar S>
Pull BSplineCurve<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        if (next_ + 1 >= this->known_) {
            return this->finished_ ? Pull::finished : Pull::starved;
        }
        // Finds the next vertex that ends the run; beyond four (degree 2: two) it does not matter.
        const std::uint64_t horizon = next_ + (degree_ == 2 ? 2 : 4);
        std::uint64_t end = next_ + 1;
        for (; end <= horizon; ++end) {
            if (!this->decided(end)) {
                return Pull::starved;
            }
            if (this->knot(end).breaks) {
                break;
            }
        }
        const auto sides = static_cast<int>(end - first_ < 3 ? end - first_ : 3);
        const int degree = sides < degree_ ? sides : degree_;
        const bool travelled = wanted(next_, degree);
        if (travelled) {
            emit(end, degree, out);
        }
        if (next_ + static_cast<std::uint64_t>(degree) == end) {
            first_ = next_ = end;
        } else {
            ++next_;
        }
        this->oldest_ = next_;
        if (travelled) {
            return Pull::item;
        }
    }
}

SPLINEFEED_INSTANTIATE_CLASS(BSplineCurve)

} // namespace splinefeed
