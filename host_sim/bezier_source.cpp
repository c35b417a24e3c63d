// SPDX-License-Identifier: MIT
#include "bezier_source.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double chord_units_per_mm = 4096.0;
static_assert(chord_unit_log2 == -12, "update chord_units_per_mm");
constexpr double negligible_mm = 1e-6; // as the core merges waypoints: a direction over less is rounding noise

} // namespace

template <Scalar S>
BezierSource<S>::BezierSource(const CurveFile& file, int axes) noexcept : file_(&file), axes_(axes) {
    SPLINEFEED_ASSERT(axes >= file.axes && axes <= max_axes && !file.segments.empty());
    for (unsigned k = 0; k < static_cast<unsigned>(file.axes); ++k) {
        here_[k] = position_from_mm(file.at(0, k));
    }
}

template <Scalar S>
Pull BezierSource<S>::next(CurveSegment<S>& out) noexcept {
    while (next_ < file_->segments.size()) {
        const CurveFile::Segment& segment = file_->segments[next_++];
        const auto degree = static_cast<unsigned>(segment.degree);
        out.axes = axes_;
        out.degree = segment.degree;
        out.origin = out.end = here_;
        out.feed_mm_s = S{};
        out.stop_at_end = false; // the arc-length stage finds the corners
        out.waypoint = static_cast<std::uint32_t>(next_ - 1);
        PerAxis<PerDegree<S>> offsets{};
        double farthest = 0.0;
        for (unsigned k = 0; k < static_cast<unsigned>(file_->axes); ++k) {
            const double start = to_mm(here_[k]);
            for (unsigned i = 1; i <= degree; ++i) {
                const double offset = file_->at(segment.first_point + i, k) - start;
                offsets[k][i] = from_double<S>(offset * chord_units_per_mm);
                farthest = std::fmax(farthest, std::fabs(offset));
            }
            out.end[k] = position_from_mm(file_->at(segment.first_point + degree, k));
        }
        if (farthest < negligible_mm) {
            continue;
        }
        here_ = out.end;
        out.assign(offsets);
        return Pull::item;
    }
    return Pull::finished;
}

template class BezierSource<double>;
template class BezierSource<float>;
template class BezierSource<Fixed>;

} // namespace splinefeed::host
