// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/path_bezier.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr int starts_log2 = 2; // four and one more, from the end to the middle
constexpr int starts = 1 << starts_log2;
constexpr int nearings = 3; // Newton's steps towards the nearest place
// Of the second derivative over the first one, as a part of itself and of 1: four roundings.
template <Scalar S>
constexpr int bend_digits = std::same_as<S, float>    ? 22
                            : std::same_as<S, double> ? 50
                                                      : 30;

} // namespace

template <Scalar S>
void PathBezier<S>::set(const BezierShape<S>& shape, const PerAxis<S>& to, int axes) noexcept {
    axes_ = axes;
    degree_ = shape.degree;
    points_ = shape.points;
    for (const unsigned k : indices(axes)) {
        points_[k][0] = S{};
        points_[k][static_cast<unsigned>(degree_)] = to[k];
    }
}

template <Scalar S>
S PathBezier<S>::polygon() const noexcept {
    S length{};
    for (const unsigned i : indices(degree_)) {
        length += norm(leg(points_, i, i + 1, axes_), axes_);
    }
    return length;
}

template <Scalar S>
bool PathBezier<S>::has_directions() const noexcept {
    const S least = scale2(polygon(), -16);
    const auto n = static_cast<unsigned>(degree_);
    return norm(leg(points_, 0, 1, axes_), axes_) > least && norm(leg(points_, n - 1, n, axes_), axes_) > least;
}

// K = (C'' - (C'' T) T) / |C'|^2.
template <Scalar S>
void PathBezier<S>::state(S u, bool from_end, PathState<S>& out) const noexcept {
    out = {};
    PerAxis<S> first{};
    PerAxis<S> second{};
    const auto n = static_cast<unsigned>(degree_);
    for (const unsigned k : indices(axes_)) {
        PerDegree<S> row = points_[k];
        if (from_end) {
            for (unsigned i = 0; i <= n; ++i) {
                row[i] = row[i] - points_[k][n];
            }
        }
        if (degree_ > 1) {
            reduce(row, degree_, 2, u);
            second[k] = from_integer<S>(degree_ * (degree_ - 1)) * (row[2] - row[1] - (row[1] - row[0]));
            reduce(row, 2, 1, u);
        }
        first[k] = from_integer<S>(degree_) * (row[1] - row[0]);
        reduce(row, 1, 0, u);
        out.offset[k] = row[0];
    }
    const S speed = norm(first, axes_);
    if (!(speed > S{})) {
        return;
    }
    divide(first, speed, axes_);
    divide(second, speed, axes_);
    out.tangent = first;
    const S along = dot(second, first, axes_);
    out.bend = each(axes_, [&](unsigned k) { return scale2(second[k] - along * first[k], bend_log2) / speed; });
    // Beside that the ends of a move are positions, in 2^-40 mm.
    const S size = from_integer<S>(1) + norm(second, axes_);
    const S of_ends =
        scale2(from_integer<S>(degree_ * degree_), bend_log2 - Position::fraction_bits - chord_unit_log2) / speed;
    out.bend_error = (scale2(size, bend_log2 - bend_digits<S>) + of_ends) / speed;
}

template <Scalar S>
void PathBezier<S>::part(S u0, S u1, PerAxis<PerDegree<S>>& out) const noexcept {
    const S one = from_integer<S>(1);
    for (const unsigned k : indices(axes_)) {
        PerDegree<S> row = points_[k];
        if (u1 < one) { // the part before u1: the first points of all degrees
            PerDegree<S> rest = row;
            for (int n = degree_; n > 0; --n) {
                reduce(rest, n, n - 1, u1);
                row[static_cast<unsigned>(degree_ - n + 1)] = rest[0];
            }
        }
        if (u0 > S{}) { // of it the part behind u0 / u1: the last points
            const S share = u0 / u1;
            for (int n = degree_; n > 0; --n) {
                reduce(row, n, n - 1, share);
            }
        }
        out[k] = row;
    }
}

template <Scalar S>
S PathBezier<S>::distance_at(S u, bool at_end, const PerAxis<S>& point) const noexcept {
    const auto apart = [&](unsigned k) {
        PerDegree<S> row = points_[k];
        const S from = at_end ? row[static_cast<unsigned>(degree_)] : S{};
        reduce(row, degree_, 0, u);
        return point[k] - (row[0] - from);
    };
    return norm(each(axes_, apart), axes_);
}

template <Scalar S>
S PathBezier<S>::distance_near(bool at_end, const PerAxis<S>& point) const noexcept {
    const S one = from_integer<S>(1);
    const S half = scale2(one, -1);
    S u{};
    S least = largest<S>();
    for (int i = 0; i <= starts; ++i) { // a step from afar may lead away: begin at the nearest of these
        const S away = scale2(from_integer<S>(i), -1 - starts_log2);
        const S at = at_end ? one - away : away;
        const S distance = distance_at(at, at_end, point);
        if (distance < least) {
            least = distance;
            u = at;
        }
    }
    for (int i = 0; i <= nearings; ++i) {
        PerAxis<S> apart{};
        PerAxis<S> first{};
        for (const unsigned k : indices(axes_)) {
            PerDegree<S> row = points_[k];
            const S from = at_end ? row[static_cast<unsigned>(degree_)] : S{};
            reduce(row, degree_, 1, u);
            first[k] = from_integer<S>(degree_) * (row[1] - row[0]);
            apart[k] = point[k] - (row[0] + u * (row[1] - row[0]) - from);
        }
        least = smaller(least, norm(apart, axes_));
        const S speed = norm(first, axes_);
        if (!(speed > S{})) {
            break;
        }
        divide(first, speed, axes_);
        divide(apart, speed, axes_);
        const S ahead = dot(first, apart, axes_);
        const S next = at_end ? larger(half, smaller(one, u + ahead)) : larger(S{}, smaller(half, u + ahead));
        if (next == u) {
            break; // it is the foot, or an end
        }
        u = next;
    }
    return least;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(PathBezier)
#endif

} // namespace splinefeed
