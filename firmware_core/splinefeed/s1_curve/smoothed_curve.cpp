// SPDX-License-Identifier: MIT
//
// At a joint of a and b the normal parts of the second derivatives are n_a^2 K_a and n_b^2 K_b. With V their sum in one
// unit, the weighted mean is K = V/(n_a^2 + n_b^2), and the segments get
//     K n_a^2 = V n_a^2/(n_a^2 + n_b^2),   K n_b^2 = V n_b^2/(n_a^2 + n_b^2):
// two weights with the sum 1. Nothing is divided by the square of a length, so nothing overflows, and Fixed keeps its
// digits for any ratio of the segments. That ratio is stored as a mantissa and an exponent.
#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr int quintic = 5;

/// r' and r'' at an end of a segment, by its parameter, in its unit.
template <Scalar S>
struct Derivatives {
    PerAxis<S> first{};
    PerAxis<S> second{};
    S length{}; ///< |first|
};

template <Scalar S>
Derivatives<S> derivatives_at(const CurveSegment<S>& segment, bool at_end) noexcept {
    const auto n = static_cast<unsigned>(segment.degree);
    const S degree = from_integer<S>(segment.degree);
    const S degree2 = from_integer<S>(segment.degree * (segment.degree - 1));
    Derivatives<S> out;
    for (const unsigned k : indices(segment.axes)) {
        const PerDegree<S>& b = segment.control[k];
        const S leg = at_end ? b[n] - b[n - 1] : b[1] - b[0];
        out.first[k] = leg * degree;
        if (n > 1) {
            const S inner = at_end ? b[n - 1] - b[n - 2] : b[2] - b[1];
            out.second[k] = (at_end ? leg - inner : inner - leg) * degree2;
        }
    }
    out.length = norm(out.first, segment.axes);
    return out;
}

/// A length as mantissa and exponent.
template <Scalar S>
struct Size {
    S mantissa{};     ///< in [2^14, 2^15)
    int exponent = 0; ///< length in mm is mantissa * 2^exponent
};

template <Scalar S>
Size<S> size_of(S length, int unit_log2) noexcept {
    const int up = 14 - exponent_of(length);
    return {scale2(length, up), unit_log2 - up};
}

// A normal part this large moves the segment by about its own size: 0.018 * 2^22.
template <Scalar S>
constexpr S most_change() noexcept {
    return literal<S>(0x1p22);
}

/// The mean of the two directions. False: it is a corner, or a piece has none.
template <Scalar S>
bool mean_direction(const Derivatives<S>& a, const Derivatives<S>& b, int axes, PerAxis<S>& direction) noexcept {
    const S least = literal<S>(1); // of 2^15 to 2^16, the size of the segment
    if (!(a.length >= least && b.length >= least)) {
        return false;
    }
    PerAxis<S> from = a.first;
    PerAxis<S> to = b.first;
    divide(from, a.length, axes);
    divide(to, b.length, axes);
    if (norm(difference(to, from, axes), axes) > literal<S>(0x1p-10)) {
        return false;
    }
    direction = plus(from, to, axes);
    divide(direction, norm(direction, axes), axes);
    return true;
}

} // namespace

// Decides whether the joint of current_ and ahead_ is smoothed, and fills end_ and next_start_.
template <Scalar S>
void SmoothedCurve<S>::join() noexcept {
    end_ = {};
    next_start_ = {};
    if (current_.stop_at_end || (current_.degree == 1 && ahead_.degree == 1)) {
        return;
    }
    const int axes = current_.axes;
    const Derivatives<S> a = derivatives_at(current_, true);
    const Derivatives<S> b = derivatives_at(ahead_, false);
    PerAxis<S> direction{};
    if (!mean_direction(a, b, axes, direction)) {
        return;
    }
    // The longer tangent is `one`; the other one has the ratio m 2^e to it, with m in (1/2, 2) and e <= 0 except for
    // rounding.
    const Size<S> size_a = size_of(a.length, current_.unit_log2);
    const Size<S> size_b = size_of(b.length, ahead_.unit_log2);
    const bool a_longer = size_a.exponent > size_b.exponent;
    const Size<S>& one = a_longer ? size_a : size_b;
    const Size<S>& other = a_longer ? size_b : size_a;
    const S m = other.mantissa / one.mantissa;
    const int e = larger(other.exponent - one.exponent, -48); // below that the weight is 1 to the last digit
    const S square = m * m;
    const S weight_one = literal<S>(1) / (literal<S>(1) + scale2(square, 2 * e));
    const S weight_other = square * weight_one; // times 2^(2e)
    // V in the larger of the two units, in which neither term exceeds the range of the other.
    const int unit_one = a_longer ? current_.unit_log2 : ahead_.unit_log2;
    const int unit_other = a_longer ? ahead_.unit_log2 : current_.unit_log2;
    const int unit = larger(unit_one, unit_other);
    const int up_one = -larger(unit_one - unit, -96);
    const int up_other = -larger(unit_other - unit, -96);
    const Derivatives<S>& at_one = a_longer ? a : b;
    const Derivatives<S>& at_other = a_longer ? b : a;
    const S along_one = dot(at_one.second, direction, axes);
    const S along_other = dot(at_other.second, direction, axes);
    End& end_one = a_longer ? end_ : next_start_;
    End& end_other = a_longer ? next_start_ : end_;
    const S most_one = scale2(most_change<S>(), -up_one);
    const S most_other = scale2(most_change<S>(), smaller(larger(-up_other - 2 * e, -96), 96));
    for (const unsigned k : indices(axes)) {
        const S normal_one = at_one.second[k] - along_one * direction[k];
        const S normal_other = at_other.second[k] - along_other * direction[k];
        const S v = scale2(normal_one, -up_one) + scale2(normal_other, -up_other);
        if (absolute(v) * weight_one > most_one || absolute(v) * weight_other > most_other) {
            return;
        }
        end_one.curvature[k] = scale2(v * weight_one, up_one);
        end_other.curvature[k] = scale2(v * weight_other, larger(up_other + 2 * e, -96));
        end_one.tangent[k] = direction[k] * at_one.length;
        end_other.tangent[k] = direction[k] * at_other.length;
        end_one.direction[k] = end_other.direction[k] = direction[k];
    }
    end_one.shared = end_other.shared = true;
}

namespace {

/// r' and r'' that a segment gets at an end.
template <Scalar S, class End>
Derivatives<S> promoted(const CurveSegment<S>& segment, bool at_end, const End& end) noexcept {
    Derivatives<S> own = derivatives_at(segment, at_end);
    if (end.shared) {
        const S along = dot(own.second, end.direction, segment.axes);
        own.first = end.tangent;
        own.second = end.curvature;
        add(own.second, along, end.direction, segment.axes);
    }
    return own;
}

} // namespace

// The quintic with the derivatives at both ends: b1 = b0 + r'/5, b2 = 2 b1 - b0 + r''/20, and the same from the other
// end.
template <Scalar S>
void SmoothedCurve<S>::emit(CurveSegment<S>& out) const noexcept {
    out = current_;
    if (!start_.shared && !end_.shared) {
        return;
    }
    const Derivatives<S> from = promoted(current_, false, start_);
    const Derivatives<S> to = promoted(current_, true, end_);
    const auto last = static_cast<unsigned>(current_.degree);
    const S five = from_integer<S>(5);
    const S twenty = from_integer<S>(20);
    PerAxis<PerDegree<S>> control{};
    for (const unsigned k : indices(current_.axes)) {
        const S p0 = current_.control[k][0];
        const S p5 = current_.control[k][last];
        const S leg_in = from.first[k] / five;
        const S leg_out = to.first[k] / five;
        control[k][0] = p0;
        control[k][1] = p0 + leg_in;
        control[k][2] = p0 + (leg_in + leg_in) + from.second[k] / twenty;
        control[k][3] = p5 - (leg_out + leg_out) + to.second[k] / twenty;
        control[k][4] = p5 - leg_out;
        control[k][5] = p5;
    }
    out.degree = quintic;
    out.assign(control);
    out.unit_log2 += current_.unit_log2 - chord_unit_log2; // assign takes chord units, but these are the units of the
                                                           // segment
}

template <Scalar S>
Pull SmoothedCurve<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        if (!has_current_) {
            const Pull pull = source_->next(current_);
            if (pull != Pull::item) {
                return pull;
            }
            SPLINEFEED_ASSERT(current_.degree <= quintic && max_degree >= quintic);
            has_current_ = true;
        }
        if (!source_finished_) {
            const Pull pull = source_->next(ahead_);
            if (pull == Pull::starved) {
                return pull;
            }
            source_finished_ = pull == Pull::finished;
            SPLINEFEED_ASSERT(source_finished_ || ahead_.degree <= quintic);
        }
        const bool last = source_finished_;
        const bool outside = seam_ == Seam::repeated && (lead_in_ || last);
        if (last) {
            end_ = {};
            next_start_ = {};
        } else {
            join();
        }
        if (!outside) {
            emit(out);
        }
        lead_in_ = false;
        start_ = next_start_;
        if (last) {
            has_current_ = false; // from now on the source answers `finished`
        } else {
            current_ = ahead_;
        }
        if (!outside) {
            return Pull::item;
        }
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(SmoothedCurve)
#endif

} // namespace splinefeed
