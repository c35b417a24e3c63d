// SPDX-License-Identifier: MIT
// JerkMemory: a JerkPlanner with its memory, on the heap.
#pragma once

#include "splinefeed/jerk_planner.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace splinefeed::hal {

/// It looks a quarter as far ahead as its window: what it plans far ahead is planned again later.
template <Scalar S, Floating R>
struct JerkMemory {
    explicit JerkMemory(std::span<PlannedCell<S>> window)
        : cells(cells_of(window.size())), nodes(cells.size() + 1), scratch(nodes.size()),
          planner(window, {cells, nodes, scratch}) {}

    [[nodiscard]] static std::size_t cells_of(std::size_t window) noexcept {
        const std::size_t ahead = std::max(window / 4, JerkPlan<S, double>::smallest_window);
        return ahead + std::min(ahead / 3, JerkWindow<S, double>::most_spare); // a quarter is free
    }

    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof planner + cells.size() * sizeof cells[0] + nodes.size() * (sizeof nodes[0] + sizeof scratch[0]);
    }

    std::vector<Cell<S>> cells;
    std::vector<JerkNode<R>> nodes;
    std::vector<LegNode<R>> scratch;
    JerkPlanner<S, R> planner;
};

} // namespace splinefeed::hal
