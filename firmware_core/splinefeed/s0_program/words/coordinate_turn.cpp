// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/coordinate_turn.hpp"

#include <bit>

namespace splinefeed {

namespace {

constexpr Decimal least_radius{2 * (Decimal::one / 10000)}; // as of program_arc
constexpr std::int64_t most_scaled = std::int64_t{1} << 61; // beyond any place, and sums do not overflow

// value * factor / divisor, within what can be added to a place.
Decimal stretched(Decimal value, std::int64_t factor, std::int64_t divisor) noexcept {
    const std::int64_t raw = product_quotient(value.raw, factor, static_cast<std::uint64_t>(divisor)).raw;
    return {raw > most_scaled ? most_scaled : raw < -most_scaled ? -most_scaled : raw};
}

} // namespace

void CoordinateTurn::rotate(unsigned first, unsigned second, const Point& centre, Decimal degrees) noexcept {
    first_ = first;
    second_ = second;
    angle_.raw = degrees.raw % Decimal::full_turn;
    turn_ = sine_cosine(angle_);
    centre_ = centre;
    scale_point(centre_, false);
}

void CoordinateTurn::scale(std::uint32_t axes, const Point& centre, Decimal factor) noexcept {
    scaled_ = axes;
    scale_centre_ = centre;
    factor_ = factor;
}

void CoordinateTurn::mirror(unsigned axis, Decimal place, bool in_plane) noexcept {
    mirrored_ |= bit(axis);
    in_plane_ = in_plane ? in_plane_ | bit(axis) : in_plane_ & ~bit(axis);
    mirror_[axis] = place;
}

void CoordinateTurn::mirror_point(Point& point) const noexcept {
    for (const unsigned k : indices(max_axes)) {
        if ((mirrored_ & bit(k)) != 0) {
            point[k] = mirror_[k] + mirror_[k] - point[k];
        }
    }
}

void CoordinateTurn::scale_point(Point& point, bool back) const noexcept {
    for (const unsigned k : indices(max_axes)) {
        if (scales() && (scaled_ & bit(k)) != 0) {
            const Decimal way = point[k] - scale_centre_[k];
            point[k] = scale_centre_[k] +
                       (back ? stretched(way, Decimal::one, factor_.raw) : stretched(way, factor_.raw, Decimal::one));
        }
    }
}

void CoordinateTurn::rotate_point(Point& point, bool back) const noexcept {
    if (!rotates()) {
        return;
    }
    const std::int64_t sine = back ? -turn_.sine : turn_.sine;
    const Decimal x = point[first_] - centre_[first_];
    const Decimal y = point[second_] - centre_[second_];
    point[first_] = centre_[first_] + (turned(x, turn_.cosine) - turned(y, sine));
    point[second_] = centre_[second_] + (turned(x, sine) + turned(y, turn_.cosine));
}

void CoordinateTurn::apply(Point& point) const noexcept {
    mirror_point(point);
    scale_point(point, false);
    rotate_point(point, false);
}

void CoordinateTurn::undo(Point& point) const noexcept {
    rotate_point(point, true);
    scale_point(point, true);
    mirror_point(point);
}

bool CoordinateTurn::apply_to_arc(Decimal& radius, Decimal& sweep_deg) const noexcept {
    sweep_deg = std::popcount(mirrored_ & in_plane_) == 1 ? -sweep_deg : sweep_deg;
    radius = scales() ? stretched(radius, factor_.raw, Decimal::one) : radius;
    return !scales() || radius >= least_radius;
}

} // namespace splinefeed
