// SPDX-License-Identifier: MIT
// StatePolygon: a convex set of states of motion along the path. It is used for the states from which a cell and the
// path after it can be travelled within the limits.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace splinefeed {

/// The motion at a node: b = v^2 and its slope db/ds, which is twice the acceleration along the path.
struct SpeedState {
    double b;     ///< [mm^2/s^2]
    double slope; ///< [mm/s^2]
};

/// The half-plane of_b * b + of_slope * slope <= limit.
struct StateBound {
    double of_b;
    double of_slope;
    double limit;

    /// How far a state is outside the bound; negative: inside it.
    [[nodiscard]] constexpr double excess(const SpeedState& state) const noexcept {
        return of_b * state.b + of_slope * state.slope - limit;
    }
};

/// The corners are in counter-clockwise order; one or two corners are a point or a line. A plain value.
class StatePolygon {
public:
    static constexpr std::size_t capacity = 96; ///< corners while it is being cut
    static constexpr std::size_t kept = 20;     ///< corners that simplify() leaves

    StatePolygon() noexcept = default; // the corners have no values yet
    /// @pre convex and counter-clockwise, at most `capacity`
    explicit StatePolygon(std::span<const SpeedState> corners) noexcept;
    /// All states with 0 <= b <= largest_b and |slope| <= max_path_acceleration.
    StatePolygon(double largest_b, double max_path_acceleration) noexcept;

    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] bool full() const noexcept { return size_ + 2 > capacity; } ///< one more cut might not fit
    [[nodiscard]] std::span<const SpeedState> corners() const noexcept { return {corner_.data(), size_}; }

    void clear() noexcept { size_ = 0; }
    /// @pre fewer corners than capacity; the corners stay convex and counter-clockwise
    void append(const SpeedState& state) noexcept { corner_[size_++] = state; }
    /// Keeps the part inside the bound. Returns the number of corners before the first one outside it; these stay where
    /// they are. Cost: two products per corner.
    std::size_t cut(const StateBound& bound) noexcept;
    /// Removes the corners that cost the least area until at most `kept` are left. The result is a part of the old
    /// polygon.
    void simplify() noexcept;
    /// The smallest convex polygon that contains this one and the state. @pre three corners or more, fewer than
    /// capacity
    void include(const SpeedState& state) noexcept;
    /// The half-planes that bound it: one per side; for a line also one at each end; four for a point. Returns their
    /// number.
    [[nodiscard]] std::size_t bounds(std::span<StateBound> out) const noexcept;

private:
    std::array<SpeedState, capacity> corner_;
    std::size_t size_ = 0;
};

} // namespace splinefeed
