// SPDX-License-Identifier: MIT
//
// Vertices are blossoms d_i = f(U_{i+1}, U_{i+2}, U_{i+3}) over the knots. Along the side d_i -> d_{i+1} one argument
// runs from U_{i+1} to U_{i+4}, and where it passes a knot of the piece there is a Bezier point:
//
//   b1 = f(a, a, b), b2 = f(a, b, b) on the side `along` of the piece [a, b],
//   b0 = f(a, a, a) = (b2 of the piece before + b1) / 2, because both knot intervals are 1; b3 in the same way.
//
// Seen from the joint, the neighbouring Bezier point is one part of its side away.
#include "splinefeed/splines/boehm.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

// x * times / parts. Integers divide without remainder if the vertices are multiples of boehm_scale.
template <BoehmNumber N>
N share(N x, int times, int parts) noexcept {
    if (times == 0) {
        return N{};
    }
    const N multiple = times == 2 ? x + x : x;
    if constexpr (std::same_as<N, std::int64_t>) {
        return multiple / parts;
    } else {
        return parts == 1 ? multiple : multiple / from_integer<N>(parts);
    }
}

// Exact except for the last bit of Fixed and of integers.
template <BoehmNumber N>
N half_of(N x) noexcept {
    if constexpr (std::same_as<N, std::int64_t>) {
        return x / 2;
    } else {
        return half(x);
    }
}

template <BoehmNumber N>
Status check(std::span<const PerAxis<N>> vertices, int degree, bool closed, std::size_t storage) noexcept {
    if (degree != 2 && degree != 3) {
        return Error::degree_out_of_range;
    }
    const std::int64_t count = boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed);
    if (count < 1) {
        return Error::too_few_points;
    }
    if (storage < static_cast<std::size_t>(count)) {
        return Error::storage_too_small;
    }
    N most{};
    if constexpr (std::same_as<N, std::int64_t>) {
        most = std::int64_t{1} << 60;
    } else {
        most = scale2(largest<N>(), -3);
    }
    for (const PerAxis<N>& vertex : vertices) {
        for (const N x : vertex) {
            if (!(x <= most && x >= -most)) {
                if constexpr (Scalar<N>) {
                    if (!within(x, largest<N>())) {
                        return Error::position_out_of_range;
                    }
                }
                return Error::result_out_of_range;
            }
        }
    }
    return {};
}

template <BoehmNumber N>
PerAxis<N> between(const PerAxis<N>& from, const PerAxis<N>& to) noexcept {
    PerAxis<N> out{};
    for (unsigned k = 0; k < out.size(); ++k) {
        out[k] = to[k] - from[k];
    }
    return out;
}

// Piece `piece` of a checked curve, in coordinates.
template <BoehmNumber N>
void make_piece(std::span<const PerAxis<N>> vertices, int degree, bool closed, std::size_t piece, std::size_t pieces,
                BoehmPoints<N>& out) noexcept {
    const std::size_t count = vertices.size();
    // The vertex from which the points are offsets: closed, the one with the piece's number; open, the second one of
    // the piece.
    const std::size_t at = closed ? piece : piece + 1;
    const PerAxis<N>& here = vertices[at];
    const PerAxis<N>& next = vertices[(at + 1) % count];
    const PerAxis<N> before = between(vertices[(at + count - 1) % count], here);
    const PerAxis<N> along = between(here, next);
    if (degree == 2) {
        boehm_quadratic(before, along, !closed && piece == 0, !closed && piece + 1 == pieces, out);
    } else {
        const SideParts parts =
            closed ? SideParts{}
                   : SideParts::of_open(static_cast<std::int64_t>(piece), static_cast<std::int64_t>(pieces));
        boehm_cubic(before, along, between(next, vertices[(at + 2) % count]), parts, out);
    }
    for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
        for (unsigned k = 0; k < here.size(); ++k) {
            out[i][k] = here[k] + out[i][k];
        }
    }
}

} // namespace

template <BoehmNumber N>
void boehm_cubic(const PerAxis<N>& before, const PerAxis<N>& along, const PerAxis<N>& after, const SideParts& parts,
                 BoehmPoints<N>& out) noexcept {
    for (unsigned k = 0; k < before.size(); ++k) {
        const N first = share(along[k], parts.skipped, parts.along);
        const N second = share(along[k], parts.skipped + 1, parts.along);
        out[0][k] = parts.before == 0 ? -before[k] : half_of(first - share(before[k], 1, parts.before));
        out[1][k] = first;
        out[2][k] = second;
        out[3][k] =
            parts.after == 0 ? along[k] + after[k] : half_of(second + (along[k] + share(after[k], 1, parts.after)));
    }
}

template <BoehmNumber N>
void boehm_quadratic(const PerAxis<N>& before, const PerAxis<N>& after, bool clamped_start, bool clamped_end,
                     BoehmPoints<N>& out) noexcept {
    for (unsigned k = 0; k < before.size(); ++k) {
        out[0][k] = clamped_start ? -before[k] : -half_of(before[k]);
        out[1][k] = N{};
        out[2][k] = clamped_end ? after[k] : half_of(after[k]);
    }
}

template <Scalar S>
Status boehm(std::span<const Point<S>> vertices, int degree, bool closed, std::span<BezierPiece<S>> pieces) noexcept {
    if (const Status status = check<S>(vertices, degree, closed, pieces.size()); !status.ok()) {
        return status;
    }
    const auto count =
        static_cast<std::size_t>(boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed));
    for (std::size_t i = 0; i < count; ++i) {
        BoehmPoints<S> points{};
        make_piece<S>(vertices, degree, closed, i, count, points);
        pieces[i].degree = degree;
        for (int j = 0; j <= degree; ++j) {
            pieces[i].set_point(j, points[static_cast<unsigned>(j)]);
        }
    }
    return {};
}

Status boehm(std::span<const PerAxis<std::int64_t>> vertices, int degree, bool closed,
             std::span<BoehmPoints<std::int64_t>> pieces) noexcept {
    if (const Status status = check<std::int64_t>(vertices, degree, closed, pieces.size()); !status.ok()) {
        return status;
    }
    const auto count =
        static_cast<std::size_t>(boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed));
    for (std::size_t i = 0; i < count; ++i) {
        make_piece<std::int64_t>(vertices, degree, closed, i, count, pieces[i]);
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(N)                                                                                      \
    template void boehm_cubic(const PerAxis<N>&, const PerAxis<N>&, const PerAxis<N>&, const SideParts&,               \
                              BoehmPoints<N>&) noexcept;                                                               \
    template void boehm_quadratic(const PerAxis<N>&, const PerAxis<N>&, bool, bool, BoehmPoints<N>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
SPLINEFEED_INSTANTIATE(std::int64_t)
#undef SPLINEFEED_INSTANTIATE

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status boehm(std::span<const Point<S>>, int, bool, std::span<BezierPiece<S>>) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
