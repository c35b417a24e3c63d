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

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

// Control points are below 2^16 units. The second derivative of a cubic contains 24 of their roundings; twice that is
// allowed. Rounding is no reason to halve: halving makes it larger in proportion.
template <Scalar S>
constexpr S control_noise = literal<S>(1e-8);
template <>
constexpr float control_noise<float> = 48.0F * 65536.0F / 16777216.0F;

// What rounding adds to the second derivative of a piece whose numbers have one word.
template <Scalar S>
constexpr Ratio<S> word_noise = literal<Ratio<S>>(std::same_as<S, Fixed> ? 0x1p-28 : 0.0);

} // namespace

template <Scalar S>
void Piece<S>::halve(int axes, int degree, PerAxis<PerDegree<S>>& left, PerAxis<PerDegree<S>>& right) const noexcept {
    const auto n = static_cast<unsigned>(degree);
    for (const unsigned k : indices(axes)) {
        PerDegree<S> row = control[k]; // a row of the triangle; its last entries become the right half
        left[k][0] = row[0];
        for (unsigned step = 1; step <= n; ++step) {
            for (unsigned i = 0; i + step <= n; ++i) {
                row[i] = half(row[i] + row[i + 1]);
            }
            left[k][step] = row[0];
        }
        right[k] = row;
    }
}

// The differences of the control points, which have the same unit in all axes, are below 1 and at least one is above
// 1/2: n times 2^-c of them is |dr/dw|, n (n - 1) times 2^-c of their differences is d2r/dw2, and 2^c is the power of
// two up to n (n - 1). |dr/dw| fits in five or six axes, too, if the differences are below 1/2.
template <Scalar S>
void PieceMeasure<S>::choose_unit(const Piece<S>& piece, unsigned degree, int axes) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        std::uint64_t bits = 1;
        for (const unsigned k : indices(axes)) {
            for (unsigned i = 0; i < degree; ++i) {
                const std::int64_t step = (piece.control[k][i + 1] - piece.control[k][i]).raw();
                bits |= static_cast<std::uint64_t>(step ^ (step >> 63));
            }
        }
        fine_log2_ = degree > 1 ? 31 - std::countl_zero(degree * (degree - 1)) : 0;
        const int step_log2 = 64 - std::countl_zero(bits) - detail::fixed_fraction_bits + (axes > 4 ? 1 : 0);
        unit_log2 = step_log2 + fine_log2_;
    }
    noise = shortened<R>(control_noise<S>, -unit_log2) + word_noise<S>;
}

template <Scalar S>
void PieceMeasure<S>::differentiate(const Piece<S>& piece, int degree, int axes) noexcept {
    const auto n = static_cast<unsigned>(degree);
    choose_unit(piece, n, axes);
    const R factor = shortened<R>(from_integer<S>(degree), -fine_log2_);
    const R factor2 = shortened<R>(from_integer<S>(degree * (degree - 1)), -fine_log2_);
    for (const unsigned k : indices(axes)) {
        const PerDegree<S>& b = piece.control[k];
        PerDegree<R> step{}; // a row of the triangle of differences
        for (unsigned i = 0; i < n; ++i) {
            step[i] = shortened_to_fit<R>(b[i + 1] - b[i], fine_log2_ - unit_log2);
        }
        first[0][k] = step[0] * factor;
        first[2][k] = step[n - 1] * factor;
        second[0][k] = second[1][k] = second[2][k] = R{};
        if (n > 1) {
            second[0][k] = (step[1] - step[0]) * factor2;
            second[2][k] = (step[n - 1] - step[n - 2]) * factor2;
        }
        for (unsigned size = n; size > 1; --size) {
            if (size == 2) {
                second[1][k] = (step[1] - step[0]) * factor2;
            }
            for (unsigned i = 0; i + 1 < size; ++i) {
                step[i] = mean(step[i], step[i + 1]);
            }
        }
        first[1][k] = step[0] * factor;
    }
    for (unsigned p = 0; p < points; ++p) {
        sigma[p] = norm(first[p], axes);
    }
    slowest = smaller(sigma[0], smaller(sigma[1], sigma[2]));
    fastest = larger(sigma[0], larger(sigma[1], sigma[2]));
}

template <Scalar S>
void PieceMeasure<S>::measure_length(int axes, int segment_unit_log2) noexcept {
    for (unsigned p = 0; p < points; ++p) {
        by_sigma_[p] = DivisionBy<R>(sigma[p]);
        slope[p] = R{};
        for (const unsigned k : indices(axes)) {
            first[p][k] = first[p][k] / by_sigma_[p];
            slope[p] += first[p][k] * second[p][k];
        }
    }
    const R ends = (sigma[0] - sigma[1]) + (sigma[2] - sigma[1]);
    const R bend = slope[0] - slope[2];
    // The error of rounded constants is the same in every cell, and would add up. But they are factors of differences,
    // which are small beside the length.
    length = sigma[1] + literal<R>(7.0 / 30.0) * ends + literal<R>(1.0 / 60.0) * bend;
    // Less (sigma_0 + sigma_1)/2 + (sigma_0' - sigma_1')/12, without the roundings of two lengths, and times 8: in
    // Fixed a rounding is up to a hundredth of it.
    length_error = absolute(literal<R>(8.0 / 15.0) * (times(4, ends) + bend));
    length_mm = lengthened<S>(length, unit_log2 + segment_unit_log2);
    // Computed for sigma = 1 + 2 q (w - 1/2)^2 the error of the inverse is 0.045 q^3; for sigma = 1 + p w it is below
    // 0.045 p^6. If both are mixed, the value at the middle may not show the error.
    const R slant = (sigma[2] - sigma[0]) / by_sigma_[1];
    const R bow = absolute(ends) / by_sigma_[1] + slant * slant;
    const R scaled = scale2(bow, 3); // otherwise Fixed would lose the digits of its cube
    shape_error = literal<R>(0.045 * 8.0) * scaled * scaled * scaled;
}

// With g = L / sigma, h = -(sigma'/sigma) g^2 / 2 and d = g - 1 at the ends, the quintic g_0 x + h_0 x^2 + a_3 x^3 +
// ... is a_3 = -6 d_0 - 4 d_1 - 3 h_0 + h_1, a_4 = 8 d_0 + 7 d_1 + 3 h_0 - 2 h_1, a_5 = -3 d_0 - 3 d_1 - h_0 + h_1. It
// is summed so that in Fixed the coefficients add up to 1 to the last bit: the cell ends where its curve ends.
template <Scalar S>
void PieceMeasure<S>::invert() noexcept {
    const R one = from_integer<R>(1);
    for (unsigned p = 0; p < points; ++p) {
        stretch_[p] = length / by_sigma_[p];
    }
    const R g0 = stretch_[0];
    const R g1 = stretch_[2];
    const R d0 = g0 - one;
    const R d1 = g1 - one;
    const R h0 = -half(slope[0] / by_sigma_[0] * g0 * g0);
    const R h1 = -half(slope[2] / by_sigma_[2] * g1 * g1);
    const R a5 = h1 - h0 - times(3, d0 + d1);
    const R a4 = times(2, d0 - a5) + d1 + h0;
    const R a3 = -(d0 + h0 + a4 + a5);
    // The first half of the quartic's integral: L/2 + 5/32 (sigma_0 - sigma_1) + (sigma_0' + sigma_1') / 64.
    by_length_ = DivisionBy<R>(length);
    const R x = half(one) + by_length(scale2(times(5, sigma[0] - sigma[2]), -5) + scale2(slope[0] + slope[2], -6));
    by_hump_ = DivisionBy<R>(x * (one - x));
    const R w = x * (g0 + x * (h0 + x * (a3 + x * (a4 + x * a5))));
    const R c = (half(one) - w) / by_hump_ / by_hump_ / by_hump_;
    inverse = {g0, h0, a3 + c, a4 - times(3, c), a5 + times(3, c), -c};
    if constexpr (std::same_as<S, Fixed>) {
        // A cell has four times their deviation from w = x. Where that overflows, the piece is accepted as it is, but
        // much too uneven.
        const R most = literal<R>(0.499);
        bool fits = absolute(d0) < most;
        R sum{};
        for (unsigned i = 0; i < inverse.size(); ++i) {
            fits = fits && (i == 0 || absolute(inverse[i]) < most);
            sum += inverse[i];
        }
        if (!fits || sum != one) {
            inverse = {one, R{}, R{}, R{}, R{}, R{}};
        }
    }
    R derivative{};
    for (unsigned i = 6; i-- > 0;) {
        derivative = derivative * x + times(static_cast<int>(i) + 1, inverse[i]);
    }
    middle = x;
    middle_slope = derivative;
}

// L d2q/ds2 = L (r'' - q' (q' r'')) / sigma^2, where L is the length as length_mm has it: of a cell of nanometres Fixed
// knows only half the digits, and who divides by them must find the same d2q/ds2 on both sides of a joint.
template <Scalar S>
void PieceMeasure<S>::measure_curvature(int axes, int segment_unit_log2) noexcept {
    const R rounded = by_length(shortened<R>(length_mm, -unit_log2 - segment_unit_log2));
    for (unsigned p = 0; p < points; ++p) {
        const R stretch = stretch_[p] * rounded;
        for (const unsigned k : indices(axes)) {
            second[p][k] = (second[p][k] - first[p][k] * slope[p]) / by_sigma_[p] * stretch;
        }
    }
}

template <Scalar S>
auto PieceMeasure<S>::sharpest_bend(int axes) const noexcept -> R {
    R most{};
    for (const PerAxis<R>& bend : second) {
        most = larger(most, largest_size(bend, axes));
    }
    return most;
}

// The largest of three samples plus a quarter of their second difference: twice the amount by which a parabola can
// exceed them.
template <Scalar S>
auto PieceMeasure<S>::bound(const std::array<PerAxis<R>, points>& f, unsigned axis) noexcept -> R {
    const R second_difference = absolute(f[2][axis] - f[1][axis] - (f[1][axis] - f[0][axis]));
    return larger(absolute(f[0][axis]), larger(absolute(f[1][axis]), absolute(f[2][axis]))) +
           scale2(second_difference, -2);
}

// The error of the parabola of q'' shows in q', its integral. Let d be the difference of q' at the middle and e that at
// the end. An error x (1-x) (1-2x) of 2 L q'' reaches 6.2 d, and one like x (1-x) (1-2x)^2 reaches 3.8 e, half of which
// the middle sees as well; q' itself has the errors d and e. Each is multiplied by b <= b0 + b1.
template <Scalar S>
AxisShape<S> PieceMeasure<S>::shape(unsigned axis) const noexcept {
    const R to_end = from_integer<R>(1) - middle;
    const R c0 = times(2, second[0][axis]);
    const R c2 = times(2, second[2][axis]);
    // The parabola through the value at w = 1/2, which is at x = middle: c0 (1-x)^2 + 2 c1 x (1-x) + c2 x^2.
    const R c1 = (second[1][axis] - half(c0 * to_end * to_end) - half(c2 * middle * middle)) / by_hump_;
    const R t0 = first[0][axis];
    const R t1 = first[2][axis];
    // The Bezier points of the integral are t0 and three more, each larger by c / 6 than the one before: up to the
    // middle
    const R sixth = literal<R>(1.0 / 6.0);
    const R sum1 = sixth * c0;
    const R sum2 = sixth * (c0 + c1);
    const R sum3 = sixth * (c0 + c1 + c2);
    const R at_middle =
        middle * (times(3, sum1) * to_end * to_end + middle * (times(3, sum2) * to_end + middle * sum3));
    const R middle_rest = absolute(first[1][axis] - t0 - at_middle);
    const R end_rest = absolute(t1 - t0 - sum3);
    return {{t0, t1}, {c0, c1, c2}, times(8, middle_rest) + times(10, end_rest)};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void Piece<S>::halve(int, int, PerAxis<PerDegree<S>>&, PerAxis<PerDegree<S>>&) const noexcept;            \
    template struct PieceMeasure<S>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
