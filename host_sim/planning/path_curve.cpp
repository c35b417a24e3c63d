// SPDX-License-Identifier: MIT
#include "host_sim/planning/path_curve.hpp"

#include "host_sim/base/input_error.hpp"

namespace splinefeed::host {

namespace {

template <Scalar S>
void take_tangent(const std::optional<Tangent>& given, int axes, bool& has, PerAxis<S>& out) {
    if (!given) {
        return;
    }
    if (given->components > axes) {
        throw UsageError("an end tangent has {} components, but the path has {} axes; give one for each axis",
                         given->components, axes);
    }
    has = true;
    for (const unsigned k : indices(given->components)) {
        out[k] = from_double<S>(given->value[k]);
    }
}

void require_smoothable(const CurveFile& file) {
    for (const CurveFile::Segment& segment : file.segments) {
        if (segment.degree > 5) {
            throw UsageError("--smooth takes segments up to degree 5; there is one of degree {}", segment.degree);
        }
    }
}

} // namespace

template <Scalar S>
PathCurve<S>::PathCurve(const PathInput& input) : axes_(static_cast<int>(input.axes().size())) {
    const CurveChoice& choice = input.choice();
    EndTangents<S> tangents;
    take_tangent(choice.start_tangent, axes_, tangents.has_start, tangents.start);
    take_tangent(choice.end_tangent, axes_, tangents.has_end, tangents.end);
    Seam seam = choice.closed ? Seam::repeated : Seam::open;
    if (const CurveFile* const file = input.segments()) {
        auto& segments = curve_.template emplace<BezierSource<S>>(*file, axes_, choice.smooth);
        seam = segments.repeats_seam() ? Seam::repeated : Seam::open;
        source_ = &segments;
        if (choice.smooth) {
            require_smoothable(*file);
        }
    } else {
        CurveOptions<S> options;
        options.axes = axes_;
        options.parameterization = choice.parameterization;
        options.corner_cosine = from_double<S>(corner_cosine(choice.corner_angle_deg));
        options.seam_segments = choice.smooth && choice.closed;
        source_ = curve_.template emplace<StreamedCurve<S>>(streamed_curve(choice, options, tangents)).curve.get();
    }
    if (choice.smooth) {
        source_ = &smoothed_.emplace(*source_, seam);
    }
}

template <Scalar S>
std::size_t PathCurve<S>::bytes() const noexcept {
    const auto* const streamed = std::get_if<StreamedCurve<S>>(&curve_);
    return streamed != nullptr ? streamed->bytes : sizeof(BezierSource<S>);
}

template <Scalar S>
Status PathCurve<S>::push(const Waypoint<double>& waypoint, Role role) {
    Waypoint<S> out;
    out.position = waypoint.position;
    out.feed_mm_s = from_double<S>(waypoint.feed_mm_s);
    out.max_feed_mm_s = from_double<S>(waypoint.max_feed_mm_s);
    out.corner = waypoint.corner;
    return waypoints().push(out, role);
}

template class PathCurve<double>;
template class PathCurve<float>;
template class PathCurve<Fixed>;

} // namespace splinefeed::host
