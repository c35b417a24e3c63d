// SPDX-License-Identifier: MIT
// The rows of g2_bezier's equations (derived in g2_bezier.cpp), computed from its points one at a time.
#pragma once

#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/g2_bezier.hpp"
#include "splinefeed/splines/product_fits.hpp"

#include <array>
#include <cstddef>

namespace splinefeed::detail {

/// The row of a joint.
template <Scalar S>
struct Row {
    S beta1 = from_integer<S>(1);
    S r = from_integer<S>(1); ///< 1 / beta1
    S before{};               ///< omega': weight of the side before the joint
    S after{};                ///< omega
    S diagonal = from_integer<S>(2);
};

/// As many numbers as there are axes, if the compiler knows how many: it then keeps them in registers.
template <Scalar S, int fixed_axes>
using Numbers = std::array<S, static_cast<std::size_t>(fixed_axes > 0 ? fixed_axes : max_axes)>;

/// Calls f(0), f(1), ... for every axis. Written out for three axes: g++ unrolls loops too late to keep arrays in
/// registers, which doubled the time per point.
template <int fixed_axes, class Function>
void each_axis(std::size_t axes, const Function& f) noexcept {
    if constexpr (fixed_axes == 3) {
        f(std::size_t{0});
        f(std::size_t{1});
        f(std::size_t{2});
    } else {
        for (std::size_t k = 0; k < axes; ++k) {
            f(k);
        }
    }
}

/// A chord: its components, its length, and 1 / length if division is slow and the inverse exact enough (not in Fixed).
template <Scalar S, int fixed_axes>
struct ChordOf {
    Numbers<S, fixed_axes> e{};
    S length{};
    S inverse{};
};

/// The equations of one input, row by row. `fixed_axes`: the number of axes if the compiler knows it, otherwise 0;
/// `plain`: chord ratios without tension at all joints.
template <Scalar S, int fixed_axes, bool plain>
class Equations {
public:
    using Chord = ChordOf<S, fixed_axes>;

    explicit Equations(const G2BezierInput<S>& input) noexcept
        : p_(input.coordinates.data()), joints_(input.joints), n_(input.point_count()),
          axes_(static_cast<std::size_t>(input.axes)), closed_(input.closed) {}

    [[nodiscard]] std::size_t axes() const noexcept { return fixed_axes > 0 ? std::size_t{fixed_axes} : axes_; }
    [[nodiscard]] Error error() const noexcept { return error_; }

    /// The chord from a point to the next one, cyclic.
    [[nodiscard]] Chord chord(std::size_t i) noexcept {
        Chord out;
        const S* const from = p_ + i * axes();
        const S* const to = i + 1 < n_ ? from + axes() : p_;
        each_axis<fixed_axes>(axes(), [&](std::size_t k) { out.e[k] = to[k] - from[k]; });
        if constexpr (!plain) {
            if (!measured(i) && !measured(i + 1 < n_ ? i + 1 : 0)) {
                return out;
            }
        }
        if constexpr (std::same_as<S, Fixed>) {
            out.length = norm(out.e, static_cast<int>(axes()));
        } else { // norm, without taking the address of values in registers
            each_axis<fixed_axes>(axes(), [&out](std::size_t k) { out.length += out.e[k] * out.e[k]; });
        }
        if (!(out.length > S{} && out.length <= largest<S>())) {
            error_ = out.length == S{} ? Error::coincident_points : Error::result_out_of_range;
            out.length = from_integer<S>(1);
        }
        if constexpr (!std::same_as<S, Fixed>) {
            out.length = square_root(out.length);
            out.inverse = from_integer<S>(1) / out.length;
        }
        return out;
    }

    /// The row of the joint at point i, between two chords.
    [[nodiscard]] Row<S> row(std::size_t i, const Chord& a, const Chord& b) noexcept {
        const S one = from_integer<S>(1);
        Row<S> out;
        if constexpr (plain) {
            by_chords(out, a, b);
        } else {
            const G2BezierJoint<S>& joint = joint_of(i);
            if (joint.chord_ratio) {
                by_chords(out, a, b);
            } else {
                out.beta1 = joint.beta1;
                out.r = quotient_or_max(one, joint.beta1);
                out.before = joint.beta1 / (one + joint.beta1);
                out.after = one / (one + joint.beta1);
            }
            if (joint.beta2 > S{}) {
                const S half = scale2(joint.beta2, -1);
                if (!product_fits(out.r, larger(half, one))) {
                    error_ = Error::result_out_of_range;
                    return out;
                }
                out.diagonal = out.diagonal + half * out.r * out.after;
            }
        }
        return out;
    }

    /// 3 (omega' e_{i-1} + omega r e_i), axis k. Sets an error before |e r| overflows.
    [[nodiscard]] S right_side(const Row<S>& row, const Chord& a, const Chord& b, std::size_t k) noexcept {
        return from_integer<S>(3) * (row.before * a.e[k] + row.after * product(row.r, b.e[k]));
    }

    /// a b; in Fixed it sets an error before an overflow. Floating-point numbers become infinite, and the result shows
    /// it.
    [[nodiscard]] S product(S a, S b) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            if (!product_fits(scale2(absolute(a), 2), absolute(b))) { // two bits more for the sums
                error_ = Error::result_out_of_range;
                return S{};
            }
        }
        return a * b;
    }

private:
    void by_chords(Row<S>& out, const Chord& a, const Chord& b) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            if (a.length < scale2(b.length, -20) || b.length < scale2(a.length, -20)) {
                error_ = Error::result_out_of_range;
                return;
            }
            out.beta1 = b.length / a.length;
            out.r = a.length / b.length;
            out.before = b.length / (a.length + b.length);
            out.after = a.length / (a.length + b.length);
        } else {
            const S inverse = from_integer<S>(1) / (a.length + b.length);
            out.beta1 = b.length * a.inverse;
            out.r = a.length * b.inverse;
            out.before = b.length * inverse;
            out.after = a.length * inverse;
        }
    }

    [[nodiscard]] const G2BezierJoint<S>& joint_of(std::size_t i) const noexcept {
        static constexpr G2BezierJoint<S> usual{};
        return joints_.empty() ? usual : joints_.size() == 1 ? joints_[0] : joints_[closed_ ? i : i - 1];
    }
    /// Whether the joint at point i needs the lengths of its chords.
    [[nodiscard]] bool measured(std::size_t i) const noexcept {
        return (closed_ || (i > 0 && i + 1 < n_)) && joint_of(i).chord_ratio;
    }

    const S* p_;
    std::span<const G2BezierJoint<S>> joints_;
    std::size_t n_;
    std::size_t axes_;
    bool closed_;
    Error error_ = Error::none;
};

} // namespace splinefeed::detail
