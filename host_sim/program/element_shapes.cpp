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

double ProgrammedArc::length() const noexcept {
    return std::hypot(std::fmax(radius_from_, radius_to_) * angle_, rise_, radius_to_ - radius_from_);
}

ProgrammedArc::Cylindrical ProgrammedArc::polar(const Vector3& point) const noexcept {
    double height = 0.0;
    const Vector3 arm = arm_of(point, centre_, axis_, height);
    const double growth = radius_to_ - radius_from_;
    Cylindrical out{std::atan2(scalar_product(arm, y_), scalar_product(arm, x_)), 0.0};
    if (std::fabs(rise_) > std::fabs(growth)) {
        out.share = (height - height_) / rise_;
    } else if (growth != 0.0) {
        out.share = (std::sqrt(scalar_product(arm, arm)) - radius_from_) / growth;
    }
    return out;
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
