// SPDX-License-Identifier: MIT
//
// With sigma = |dr/dw| and its derivative at w = 0, 1/2, 1 the length is
//
//   L = (7 sigma_0 + 16 sigma_m + 7 sigma_1) / 30 + (sigma_0' - sigma_1') / 60       (error of order 7 in the step)
//
// It is the integral of the quartic through sigma at three points and sigma' at the ends. The bounds need these values
// anyway; Gauss-Legendre would need four more evaluations. The difference to the end-point rule (sigma_0 + sigma_1)/2 +
// (sigma_0' - sigma_1')/12, of order 5, estimates the error.
//
// Inverse w(x), x = s / L: the quintic through dw/dx = L / sigma and d2w/dx2 = -(sigma'/sigma) (L / sigma)^2 at both
// ends, plus c (x (1 - x))^3, so that it also passes through w = 1/2 at the length of the first half. The slope there
// was not used for the construction; it shows how good the inverse is.
#include "splinefeed/s2_arc_length/piece.hpp"

namespace splinefeed {

template <Scalar S>
void PieceMeasure<S>::differentiate(const Piece<S>& piece, int degree, int axes) noexcept {
    const auto n = static_cast<unsigned>(degree);
    const S factor = from_integer<S>(degree);
    const S factor2 = from_integer<S>(degree * (degree - 1));
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        const PerDegree<S>& b = piece.control[k];
        first[0][k] = (b[1] - b[0]) * factor;
        first[2][k] = (b[n] - b[n - 1]) * factor;
        second[0][k] = second[1][k] = second[2][k] = S{};
        if (n > 1) {
            second[0][k] = (b[2] - b[1] - (b[1] - b[0])) * factor2;
            second[2][k] = (b[n] - b[n - 1] - (b[n - 1] - b[n - 2])) * factor2;
        }
        PerDegree<S>& row = right[k]; // a row of the triangle; its last entries become the right half
        for (unsigned i = 0; i <= n; ++i) {
            row[i] = b[i];
        }
        left[k][0] = row[0];
        for (unsigned step = 1; step <= n; ++step) {
            if (step + 1 == n) {
                second[1][k] = (row[2] - row[1] - (row[1] - row[0])) * factor2;
            }
            if (step == n) {
                first[1][k] = (row[1] - row[0]) * factor;
            }
            for (unsigned i = 0; i + step <= n; ++i) {
                row[i] = half(row[i] + row[i + 1]);
            }
            left[k][step] = row[0];
        }
    }
    for (unsigned p = 0; p < points; ++p) {
        sigma[p] = norm(first[p].data(), axes);
    }
    slowest = smaller(sigma[0], smaller(sigma[1], sigma[2]));
    fastest = larger(sigma[0], larger(sigma[1], sigma[2]));
}

template <Scalar S>
void PieceMeasure<S>::measure_length(int axes, int unit_log2) noexcept {
    for (unsigned p = 0; p < points; ++p) {
        slope[p] = S{};
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            first[p][k] = first[p][k] / sigma[p];
            slope[p] += first[p][k] * second[p][k];
        }
    }
    const S ends = sigma[0] + sigma[2];
    const S bend = slope[0] - slope[2];
    // Divided, not multiplied by rounded constants: their error would be the same in every cell and would accumulate.
    length = (times(7, ends) + times(16, sigma[1]) + half(bend)) / from_integer<S>(30);
    low_order_length = half(ends) + bend / from_integer<S>(12);
    length_mm = scale2(length, unit_log2);
    // Computed for sigma = 1 + 2 q (w - 1/2)^2 the error of the inverse is 0.045 q^3; for sigma = 1 + p w it is below
    // 0.045 p^6. If both are mixed, the value at the middle may not show the error.
    const S slant = (sigma[2] - sigma[0]) / sigma[1];
    const S bow = absolute(sigma[2] - sigma[1] - (sigma[1] - sigma[0])) / sigma[1] + slant * slant;
    const S scaled = scale2(bow, 4); // otherwise Fixed would lose the digits of its cube
    shape_error = literal<S>(0.045) * scaled * scaled * scaled;
}

template <Scalar S>
void PieceMeasure<S>::invert() noexcept {
    const S one = from_integer<S>(1);
    const S g0 = length / sigma[0];
    const S g1 = length / sigma[2];
    const S h0 = -half(slope[0] / sigma[0] * g0 * g0);
    const S h1 = -half(slope[2] / sigma[2] * g1 * g1);
    const S a3 = from_integer<S>(10) - times(6, g0) - times(4, g1) - times(3, h0) + h1;
    const S a4 = from_integer<S>(-15) + times(8, g0) + times(7, g1) + times(3, h0) - times(2, h1);
    const S a5 = from_integer<S>(6) - times(3, g0) - times(3, g1) - h0 + h1;
    // The first half of the quartic's integral: L/2 + 5/32 (sigma_0 - sigma_1) + (sigma_0' + sigma_1') / 64.
    const S x = half(one) + (scale2(times(5, sigma[0] - sigma[2]), -5) + scale2(slope[0] + slope[2], -6)) / length;
    const S hump = x * (one - x);
    const S w = x * (g0 + x * (h0 + x * (a3 + x * (a4 + x * a5))));
    const S c = (half(one) - w) / (hump * hump * hump);
    inverse = {g0, h0, a3 + c, a4 - times(3, c), a5 + times(3, c), -c};
    S derivative{};
    for (unsigned i = 6; i-- > 0;) {
        derivative = derivative * x + times(static_cast<int>(i) + 1, inverse[i]);
    }
    middle = x;
    middle_slope = derivative;
}

// d2q/ds2 = (r'' - q' (q' r'')) / sigma^2. In Fixed the quotients are scaled so that neither long nor short pieces lose
// bits: first by 2^6 (r'' stays below 2^25), then by the unit, between the two divisions.
template <Scalar S>
void PieceMeasure<S>::measure_curvature(int axes, int unit_log2) noexcept {
    for (unsigned p = 0; p < points; ++p) {
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            const S normal = scale2(second[p][k] - first[p][k] * slope[p], 6) / sigma[p];
            const S magnitude =
                smaller(quotient_or_max(scale2(absolute(normal), -6 - unit_log2), sigma[p]), from_integer<S>(sharpest));
            second[p][k] = normal < S{} ? -magnitude : magnitude;
        }
    }
}

template <Scalar S>
S PieceMeasure<S>::sharpest_bend(int axes) const noexcept {
    S most{};
    for (const PerAxis<S>& bend : second) {
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            most = larger(most, absolute(bend[k]));
        }
    }
    return most;
}

// The largest of three samples plus a quarter of their second difference: twice the amount by which a parabola can
// exceed them.
template <Scalar S>
S PieceMeasure<S>::bound(const std::array<PerAxis<S>, points>& f, unsigned axis) noexcept {
    const S second_difference = absolute(f[2][axis] - f[1][axis] - (f[1][axis] - f[0][axis]));
    return larger(absolute(f[0][axis]), larger(absolute(f[1][axis]), absolute(f[2][axis]))) +
           scale2(second_difference, -2);
}

// The error of the parabola of q'' shows in q', its integral. Let d be the difference of q' at the middle and e that at
// the end. An error x (1-x) (1-2x) of 2 L q'' reaches 6.2 d, and one like x (1-x) (1-2x)^2 reaches 3.8 e, half of which
// the middle sees as well; q' itself has the errors d and e. Each is multiplied by b <= b0 + b1.
template <Scalar S>
AxisShape<S> PieceMeasure<S>::shape(unsigned axis, int log2) const noexcept {
    const S one = from_integer<S>(1);
    const S third = literal<S>(1.0 / 3.0);
    const S twice = scale2(length_mm, log2 + 1);
    const S c0 = twice * second[0][axis];
    const S c2 = twice * second[2][axis];
    // The parabola through the value at w = 1/2, which is at x = middle: c0 (1-x)^2 + 2 c1 x (1-x) + c2 x^2.
    const S to_end = one - middle;
    const S c1 = (twice * second[1][axis] - c0 * to_end * to_end - c2 * middle * middle) / (times(2, middle) * to_end);
    const S t0 = scale2(first[0][axis], log2);
    const S t1 = scale2(first[2][axis], log2);
    // The Bezier points of the integral are t0 and three more, each larger by c / 6 than the one before: up to the
    // middle
    const S sum1 = third * half(c0);
    const S sum2 = third * half(c0 + c1);
    const S sum3 = third * half(c0 + c1 + c2);
    const S at_middle =
        middle * (times(3, sum1) * to_end * to_end + middle * (times(3, sum2) * to_end + middle * sum3));
    const S middle_rest = absolute(scale2(first[1][axis], log2) - t0 - at_middle);
    const S end_rest = absolute(t1 - t0 - sum3);
    return {{t0, t1}, {c0, c1, c2}, times(8, middle_rest) + times(10, end_rest)};
}

template struct PieceMeasure<double>;
template struct PieceMeasure<float>;
template struct PieceMeasure<Fixed>;

} // namespace splinefeed
