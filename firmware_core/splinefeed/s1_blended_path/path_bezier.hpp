// SPDX-License-Identifier: MIT
// PathBezier: a Bezier segment as a move: its states and its parts.
#pragma once

#include "splinefeed/s1_blended_path/path_element.hpp"
#include "splinefeed/s1_blended_path/path_state.hpp"

namespace splinefeed {

/// De Casteljau's construction at u, in place, until points of degree `left` remain: 0 leaves the point of the curve.
template <Scalar S>
void reduce(PerDegree<S>& row, int degree, int left, S u) noexcept {
    for (int n = degree; n > left; --n) {
        for (const unsigned i : indices(n)) {
            row[i] = row[i] + u * (row[i + 1] - row[i]);
        }
    }
}

/// Offsets are from the start of the segment, in chord units. Cost of a function: degree^2 / 2 products per axis.
template <Scalar S>
class PathBezier {
public:
    /// @pre shape.degree is 1 to 5; `to` is the offset of the end
    void set(const BezierShape<S>& shape, const PerAxis<S>& to, int axes) noexcept;

    [[nodiscard]] int degree() const noexcept { return degree_; }
    /// Length of the control polygon: not less than the length of the segment.
    [[nodiscard]] S polygon() const noexcept;
    /// Whether the direction is known at both ends: the points next to them are not on them.
    [[nodiscard]] bool has_directions() const noexcept;
    /// The state at u; its offset is from the start, or from the end.
    void state(S u, bool from_end, PathState<S>& out) const noexcept;
    /// The Bezier points of the part from u0 to u1.
    void part(S u0, S u1, PerAxis<PerDegree<S>>& out) const noexcept;
    /// Distance of a point from the segment near its end or its start, see PathMove::distance_near.
    [[nodiscard]] S distance_near(bool at_end, const PerAxis<S>& point) const noexcept;

private:
    [[nodiscard]] S distance_at(S u, bool at_end, const PerAxis<S>& point) const noexcept;

    int axes_ = 0;
    int degree_ = 0;
    PerAxis<PerDegree<S>> points_{};
};

} // namespace splinefeed
