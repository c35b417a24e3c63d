// SPDX-License-Identifier: MIT
#include "host_sim/curve/bezier_source.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double negligible_mm = 1e-6; // as the core merges waypoints: a direction over less is rounding noise

} // namespace

template <Scalar S>
BezierSource<S>::BezierSource(const CurveFile& file, int axes, bool repeat_seam) noexcept : file_(&file), axes_(axes) {
    SPLINEFEED_ASSERT(axes >= file.axes && axes <= max_axes && !file.segments.empty());
    go_to_start(0);
    repeats_ = repeat_seam && file.closed;
    for (const unsigned k : indices(file.axes)) {
        repeats_ = repeats_ && std::fabs(file.at(0, k) - file.at(file.points() - 1, k)) <= CurveFile::largest_gap_mm;
    }
    before_seam_ = after_seam_ = repeats_;
}

template <Scalar S>
void BezierSource<S>::go_to_start(std::size_t segment) noexcept {
    for (const unsigned k : indices(file_->axes)) {
        here_[k] = position_from_mm(file_->at(file_->segments[segment].first_point, k));
    }
}

template <Scalar S>
bool BezierSource<S>::negligible(std::size_t segment) const noexcept {
    const CurveFile::Segment& at = file_->segments[segment];
    double farthest = 0.0;
    for (const unsigned k : indices(file_->axes)) {
        for (unsigned i = 1; i <= static_cast<unsigned>(at.degree); ++i) {
            const double offset = file_->at(at.first_point + i, k) - file_->at(at.first_point, k);
            farthest = std::fmax(farthest, std::fabs(offset));
        }
    }
    return farthest < negligible_mm;
}

template <Scalar S>
bool BezierSource<S>::deliver(std::size_t segment, CurveSegment<S>& out) noexcept {
    const CurveFile::Segment& from = file_->segments[segment];
    const auto degree = static_cast<unsigned>(from.degree);
    out.axes = axes_;
    out.degree = from.degree;
    out.origin = out.end = here_;
    out.feed_mm_s = out.max_feed_mm_s = S{};
    out.stop_at_end = false; // the arc-length stage finds the corners
    out.waypoint = static_cast<std::uint32_t>(segment);
    PerAxis<PerDegree<S>> offsets{};
    double farthest = 0.0;
    for (const unsigned k : indices(file_->axes)) {
        const double start = to_mm(here_[k]);
        for (unsigned i = 1; i <= degree; ++i) {
            const double offset = file_->at(from.first_point + i, k) - start;
            offsets[k][i] = from_double<S>(offset * chord_units_per_mm);
            farthest = std::fmax(farthest, std::fabs(offset));
        }
        out.end[k] = position_from_mm(file_->at(from.first_point + degree, k));
    }
    if (farthest < negligible_mm) {
        return false;
    }
    here_ = out.end;
    out.assign(offsets);
    return true;
}

template <Scalar S>
Pull BezierSource<S>::next(CurveSegment<S>& out) noexcept {
    const std::size_t count = file_->segments.size();
    if (before_seam_) {
        before_seam_ = false;
        std::size_t last = count - 1;
        while (last > 0 && negligible(last)) {
            --last;
        }
        go_to_start(last);
        const bool delivered = deliver(last, out);
        go_to_start(0);
        if (delivered) {
            return Pull::item;
        }
    }
    while (next_ < count) {
        if (deliver(next_++, out)) {
            return Pull::item;
        }
    }
    if (after_seam_) {
        after_seam_ = false;
        for (std::size_t first = 0; first < count; ++first) {
            if (deliver(first, out)) {
                return Pull::item;
            }
        }
    }
    return Pull::finished;
}

template class BezierSource<double>;
template class BezierSource<float>;
template class BezierSource<Fixed>;

} // namespace splinefeed::host
