// SPDX-License-Identifier: MIT
// ControllableSet: the states at the entry of a cell from which a given set of states at its exit can be reached within
// the limits. Derivation: controllable_set.cpp.
#pragma once

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_cell.hpp"

namespace splinefeed {

/// Expected values of b at the ends of a cell. The limits are exact there and slightly too careful elsewhere. At least
/// `smallest`.
struct ExpectedSpeeds {
    static constexpr double smallest = 1e-6;
    double entry_sq = 0.0;
    double exit_sq = 0.0;
};

/// The limits inside a cell, as half-planes of the parabola b in it. Construction costs about 150 products per axis.
class ControllableSet {
public:
    ControllableSet(const CellPassage& passage, const ExpectedSpeeds& expected) noexcept;

    /// The states from which some u leads to one of the exits. The result is a subset of all such states and contains
    /// nearly all of them. Cost: about 10 products per corner and limit that matters.
    [[nodiscard]] StatePolygon from(const StatePolygon& exits) const noexcept;
    /// The values of u that lead from an entry to one of the exits; low > high if there is none.
    [[nodiscard]] CurvatureRange range(const SpeedState& entry, const StatePolygon& exits) const noexcept;

private:
    struct Row { // middle * m + entry * b'0 + exit * b'1 <= limit
        double middle;
        double entry;
        double exit;
        double limit;
    };
    struct Line { // b'0 is at most or at least of_middle * m + of_exit * b'1 + constant
        double of_middle;
        double of_exit;
        double constant;
        [[nodiscard]] double at(const SpeedState& state) const noexcept {
            return of_middle * state.b + of_exit * state.slope + constant;
        }
        [[nodiscard]] double size_at(const SpeedState& state) const noexcept {
            return absolute(of_middle * state.b) + absolute(of_exit * state.slope) + absolute(constant);
        }
    };
    static constexpr std::size_t rows_per_axis = 14;
    static constexpr std::size_t most = rows_per_axis * static_cast<std::size_t>(max_axes);
    struct Lines {
        std::array<Line, most> line;
        std::size_t size = 0;
        void keep_what_matters(const SpeedState& center, const SpeedState& half, double sign) noexcept;
        [[nodiscard]] std::size_t closest(const SpeedState& state, double sign, std::size_t guess) const noexcept;
    };

    /// The point between two states at which one line becomes the active one instead of another, as a fraction of the
    /// distance; 1: there is none.
    [[nodiscard]] static double crossing(const Line& first, const Line& second, const SpeedState& from,
                                         const SpeedState& to) noexcept {
        constexpr double least = 1e-6; // smallest value that is worth a corner
        const double at_from = absolute(first.at(from) - second.at(from));
        const double at_to = absolute(first.at(to) - second.at(to));
        const double share = at_from > 0.0 && at_to > 0.0 ? at_from / (at_from + at_to) : 1.0;
        return share > least && share < 1.0 - least ? share : 1.0;
    }
    void add_jerk(const CellPassage& passage, const ExpectedSpeeds& expected) noexcept;
    void add_acceleration(const CellPassage& passage) noexcept;

    double length_mm_;
    std::size_t rows_ = 0;
    std::array<Row, most> row_;
};

/// Removes the states that a node itself does not allow. It keeps speeds between 0 and the caps all along both cells,
/// and the acceleration of every axis. @param before, after  the cells that meet there
/// @param at_most_sq  upper bound of b that is known from elsewhere
void cut_to_node(StatePolygon& states, const CellPassage& before, const CellPassage& after, double at_most_sq) noexcept;

/// All states that a node itself allows.
[[nodiscard]] StatePolygon states_at(const CellPassage& before, const CellPassage& after, double at_most_sq) noexcept;

/// The state at the exit.
[[nodiscard]] constexpr SpeedState travelled(const SpeedState& entry, double u, double length_mm) noexcept {
    return {entry.b + (entry.slope + 0.5 * u * length_mm) * length_mm, entry.slope + u * length_mm};
}

} // namespace splinefeed
