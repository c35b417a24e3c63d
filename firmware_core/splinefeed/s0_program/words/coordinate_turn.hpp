// SPDX-License-Identifier: MIT
// CoordinateTurn: programmed points turned, scaled or mirrored before they get their place: G68, G51, G51.1.
#pragma once

#include "splinefeed/s0_program/text/elementary.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/plane_vector.hpp"

namespace splinefeed {

/// Points are in mm and degrees, by the axes of the machine. They are mirrored, then scaled, then turned.
class CoordinateTurn {
public:
    using Point = PerAxis<Decimal>;

    [[nodiscard]] bool rotates() const noexcept { return angle_.raw != 0; }
    [[nodiscard]] bool scales() const noexcept { return factor_.raw != Decimal::one; }
    [[nodiscard]] bool mirrors() const noexcept { return mirrored_ != 0; }
    [[nodiscard]] bool applies() const noexcept { return rotates() || scales() || mirrors(); }
    /// Bit k: places on axis k depend on it.
    [[nodiscard]] std::uint32_t axes() const noexcept {
        return (rotates() ? bit(first_) | bit(second_) : 0) | (scales() ? scaled_ : 0) | mirrored_;
    }
    /// Whether a place on one of the two axes depends on that on the other.
    [[nodiscard]] bool couples(unsigned axis) const noexcept {
        return rotates() && (axis == first_ || axis == second_);
    }
    /// Of two axes that are coupled. @pre couples(axis)
    [[nodiscard]] unsigned other(unsigned axis) const noexcept { return axis == first_ ? second_ : first_; }

    /// About `centre`, which is scaled as other points are. @param first, second  axes of the plane. A whole turn is
    /// none.
    void rotate(unsigned first, unsigned second, const Point& centre, Decimal degrees) noexcept;
    /// @pre 0.01 <= factor <= 10. @param axes  bit k: axis k is scaled
    void scale(std::uint32_t axes, const Point& centre, Decimal factor) noexcept;
    /// @param in_plane  the axis is one of the two of the plane
    void mirror(unsigned axis, Decimal place, bool in_plane) noexcept;
    void end_rotation() noexcept { angle_ = {}; }
    void end_scale() noexcept { factor_ = {Decimal::one}; }
    void end_mirror(unsigned axis) noexcept { mirrored_ &= ~bit(axis); }

    /// Whether both rotate in the same plane about the same point.
    [[nodiscard]] bool is_about(const CoordinateTurn& other) const noexcept {
        return first_ == other.first_ && second_ == other.second_ && centre_[first_] == other.centre_[first_] &&
               centre_[second_] == other.centre_[second_];
    }
    void apply(Point& point) const noexcept;
    /// The inverse, within 1e-9 mm for each of the three; of a scale within 1e-9 mm over its factor.
    void undo(Point& point) const noexcept;
    /// Of an arc in the plane. False: its radius would be below 0.2 um.
    [[nodiscard]] bool apply_to_arc(Decimal& radius, Decimal& sweep_deg) const noexcept;

private:
    static constexpr std::uint32_t bit(unsigned axis) noexcept { return 1U << axis; }
    void mirror_point(Point& point) const noexcept;
    void scale_point(Point& point, bool back) const noexcept;
    void rotate_point(Point& point, bool back) const noexcept;

    std::uint32_t mirrored_ = 0;
    std::uint32_t scaled_ = 0;
    std::uint32_t in_plane_ = 0; // of those that are mirrored
    unsigned first_ = 0;
    unsigned second_ = 0;
    Decimal factor_{Decimal::one};
    Decimal angle_{};
    SineCosine turn_{};
    Point mirror_{};
    Point scale_centre_{};
    Point centre_{};
};

} // namespace splinefeed
