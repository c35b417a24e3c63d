// SPDX-License-Identifier: MIT
// ChainFit: one quintic for a part of a chain, checked against the programmed lines.
#pragma once

#include "splinefeed/s1_blended_path/chain_points.hpp"
#include "splinefeed/s1_blended_path/path_state.hpp"

namespace splinefeed {

/// What a quintic has to keep: the tolerance in both directions, and a curvature not much above that of the points.
template <Scalar S>
class ChainFit {
public:
    ChainFit(ChainPoints<S>& points, std::uint64_t from, const PathState<S>& state) noexcept
        : points_(points), from_(from), state_(state) {}

    /// The quintic from the state at `from` to the one at `to`, whose |C'| is the length of the way at both ends.
    /// Whether it is within `limit` of the lines from point from - 1 to to + 1, and their points within it: measured at
    /// eight places a line. Between two places it may be farther by 1/64 of the bow of the line. Cost: nine points of
    /// the quintic, as many distances and three roots for each line.
    [[nodiscard]] bool reaches(std::uint64_t to, S limit) noexcept;

    [[nodiscard]] const PathState<S>& end_state() const noexcept { return end_; }
    /// Bezier points of degree 5, offsets from the start in chord units.
    [[nodiscard]] const PerAxis<PerDegree<S>>& quintic() const noexcept { return quintic_; }

private:
    /// A programmed line, from the start of the quintic.
    struct Line {
        PerAxis<S> start{};
        PerAxis<S> direction{};
        S length{};
    };

    void measure_way(std::uint64_t to) noexcept;
    void expand() noexcept;
    void line(std::uint64_t end, Line& out) const noexcept;
    void place(S u, PerAxis<S>& out) const noexcept;
    void derivatives(S u, PerAxis<S>& first, PerAxis<S>& second) const noexcept;
    [[nodiscard]] bool near(const PerAxis<S>& place, const Line& line, S limit) const noexcept;
    [[nodiscard]] bool near_point(const PerAxis<S>& point, S u, S limit, bool bends) const noexcept;

    ChainPoints<S>& points_;
    std::uint64_t from_;
    const PathState<S>& state_;
    PathState<S> end_;
    PerAxis<PerDegree<S>> quintic_{};
    PerAxis<PerDegree<S>> power_{}; // in units of 2^unit_ chord units
    int unit_ = 0;
    S way_{};  // length of the smoothed path
    S bend_{}; // its largest curvature
};

} // namespace splinefeed
