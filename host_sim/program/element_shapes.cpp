// SPDX-License-Identifier: MIT
#include "host_sim/program/element_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {

double scalar_product(const Vector3& a, const Vector3& b) noexcept {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 vector_product(const Vector3& a, const Vector3& b) noexcept {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The part of p - centre that is normal to the axis; `height` gets the other part.
Vector3 arm_of(const Vector3& p, const Vector3& centre, const Vector3& axis, double& height) noexcept {
    Vector3 arm{p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
    height = scalar_product(arm, axis);
    for (std::size_t k = 0; k < 3; ++k) {
        arm[k] -= height * axis[k];
    }
    return arm;
}

} // namespace

ProgrammedArc::ProgrammedArc(const Vector3& from, const Vector3& to, const Vector3& centre, const Vector3& axis,
                             double angle)
    : centre_(centre), axis_(axis) {
    double end_height = 0.0;
    x_ = arm_of(from, centre, axis, height_);
    const Vector3 end = arm_of(to, centre, axis, end_height);
    rise_ = end_height - height_;
    radius_from_ = std::sqrt(scalar_product(x_, x_));
    radius_to_ = std::sqrt(scalar_product(end, end));
    for (double& part : x_) {
        part /= std::fmax(radius_from_, 1e-12);
    }
    y_ = vector_product(axis, x_);
    const double off =
        std::remainder(angle - std::atan2(scalar_product(end, y_), scalar_product(end, x_)), 2.0 * std::numbers::pi);
    angle_ = angle - off;
    mismatch_ = std::fabs(off) * radius_to_;
}

double ProgrammedArc::extent(std::size_t k) const noexcept {
    const double turning = std::sqrt(std::fmax(0.0, 1.0 - axis_[k] * axis_[k]));
    return 2.0 * std::fmax(radius_from_, radius_to_) * turning + std::fabs(rise_ * axis_[k]);
}

double ProgrammedArc::slope(std::size_t k, double w) const noexcept {
    const double cosine = std::cos(angle_ * w);
    const double sine = std::sin(angle_ * w);
    const double growth = radius_to_ - radius_from_;
    return growth * (cosine * x_[k] + sine * y_[k]) +
           (radius_from_ + w * growth) * angle_ * (cosine * y_[k] - sine * x_[k]) + rise_ * axis_[k];
}

// The coordinate is a cosine on a slope. Between two zeros of the cosine its derivative is monotone, so that each half
// turn has one extreme at most.
ProgrammedArc::Range ProgrammedArc::range(std::size_t k) const noexcept {
    constexpr int halvings = 30; // the coordinate is off by the square of what is left
    constexpr double half_turn = std::numbers::pi;
    Range out{at(0.0).point[k], at(0.0).point[k]};
    const auto include = [&](double w) {
        const double here = at(w).point[k];
        out.low = std::fmin(out.low, here);
        out.high = std::fmax(out.high, here);
    };
    include(1.0);
    const double turned = std::fabs(angle_);
    const double largest = std::copysign(1.0, angle_) * std::atan2(y_[k], x_[k]); // the angle where the cosine is
    const double zero = std::fmod(half_turn / 2.0 + largest + 2.0 * half_turn, half_turn);
    double begin = 0.0;
    for (int n = 0; begin < 1.0; ++n) {
        const double end = std::fmin((zero + n * half_turn) / turned, 1.0); // 1 where the arc does not turn
        double low = begin;
        double high = end;
        const bool rises = slope(k, low) > 0.0;
        if (rises != (slope(k, high) > 0.0)) {
            for (int i = 0; i < halvings; ++i) {
                const double middle = 0.5 * (low + high);
                ((slope(k, middle) > 0.0) == rises ? low : high) = middle;
            }
            include(low);
        }
        begin = end;
    }
    return out;
}

// Of the derivative by w.
double ProgrammedArc::speed_sq(double radius, double others_sq) const noexcept {
    const double growth = radius_to_ - radius_from_;
    return growth * growth + radius * radius * angle_ * angle_ + rise_ * rise_ + others_sq;
}

// By Simpson's rule: the speed depends on the radius alone.
double ProgrammedArc::length(double others_sq) const noexcept {
    constexpr int parts = 32;
    double sum = 0.0;
    for (int i = 0; i <= parts; ++i) {
        const double weight = i == 0 || i == parts ? 1.0 : i % 2 == 0 ? 2.0 : 4.0;
        const double radius = radius_from_ + (radius_to_ - radius_from_) * i / parts;
        sum += weight * std::sqrt(speed_sq(radius, others_sq));
    }
    return sum / (3.0 * parts);
}

// The cube of the speed over the area of the first two derivatives.
double ProgrammedArc::least_radius(double others_sq) const noexcept {
    constexpr int parts = 32;
    const double growth = radius_to_ - radius_from_;
    const double angle_sq = angle_ * angle_;
    double least = 1e30;
    for (int i = 0; i <= parts; ++i) {
        const double radius = radius_from_ + growth * i / parts;
        const double speed = speed_sq(radius, others_sq);
        const double second = angle_sq * (radius * radius * angle_sq + 4.0 * growth * growth);
        const double both = growth * radius * angle_sq;
        const double area_sq = speed * second - both * both;
        least = area_sq > 0.0 ? std::fmin(least, speed * std::sqrt(speed / area_sq)) : least;
    }
    return least;
}

ProgrammedArc::Cylindrical ProgrammedArc::polar(const Vector3& point) const noexcept {
    double height = 0.0;
    const Vector3 arm = arm_of(point, centre_, axis_, height);
    return {std::atan2(scalar_product(arm, y_), scalar_product(arm, x_)),
            std::sqrt(scalar_product(arm, arm)) - radius_from_, height - height_};
}

CurveState ProgrammedArc::at(double w) const noexcept {
    const double cosine = std::cos(angle_ * w);
    const double sine = std::sin(angle_ * w);
    const double growth = radius_to_ - radius_from_;
    const double radius = radius_from_ + w * growth;
    CurveState state;
    for (std::size_t k = 0; k < 3; ++k) {
        const double radial = cosine * x_[k] + sine * y_[k];
        const double along = cosine * y_[k] - sine * x_[k];
        state.point[k] = centre_[k] + radius * radial + (height_ + w * rise_) * axis_[k];
        state.first[k] = growth * radial + radius * angle_ * along + rise_ * axis_[k];
        state.second[k] = 2.0 * growth * angle_ * along - radius * angle_ * angle_ * radial;
    }
    return state;
}

ProgrammedArc arc_of(const PerAxis<Position>& from, const PathElement<double>& move, int axes) noexcept {
    const auto linear = [axes](const PerAxis<Position>& place) {
        Vector3 out{};
        for (unsigned k = 0; k < 3 && k < static_cast<unsigned>(axes); ++k) {
            out[k] = to_mm(place[k]);
        }
        return out;
    };
    return {linear(from), linear(move.to), linear(move.arc.centre), move.arc.normal, move.arc.sweep_rad};
}

CurveState rational_state(const BezierPiece<double>& piece, double t) noexcept {
    const auto degree = static_cast<unsigned>(piece.degree);
    const double n = piece.degree;
    std::array<std::array<double, 3>, 4> value{}; // of each axis: value, first, second derivative
    for (unsigned k = 0; k < 4; ++k) {
        PerDegree<double> row = piece.control[k];
        for (unsigned last = degree; last > 0; --last) {
            if (last == 2) {
                value[k][2] = n * (n - 1.0) * (row[2] - 2.0 * row[1] + row[0]);
            } else if (last == 1) {
                value[k][1] = n * (row[1] - row[0]);
            }
            for (unsigned i = 0; i < last; ++i) {
                row[i] += t * (row[i + 1] - row[i]);
            }
        }
        value[k][0] = row[0];
    }
    const auto& w = value[3];
    CurveState state;
    for (std::size_t k = 0; k < 3; ++k) {
        state.point[k] = value[k][0] / w[0];
        state.first[k] = (value[k][1] - w[1] * state.point[k]) / w[0];
        state.second[k] = (value[k][2] - 2.0 * w[1] * state.first[k] - w[2] * state.point[k]) / w[0];
    }
    return state;
}

} // namespace splinefeed::host
