// SPDX-License-Identifier: MIT
// CellWindow: the ring of cells that a plan looks ahead in.
//
//      front                 size            measured         room
//        |  cells of the plan  |  cells to come  |   empty      |
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/s3_feed_plan/acceleration/planned_cell.hpp"

#include <cstddef>
#include <span>

namespace splinefeed {

/// The storage is the caller's. Cells are measured ahead of the plan, and the plan takes them when it wants to know
/// more of the path. So what it computes does not depend on when they were measured. Cost of every function: constant.
template <Scalar S>
class CellWindow {
public:
    explicit CellWindow(std::span<PlannedCell<S>> storage) noexcept : storage_(storage) {}

    /// The i-th cell from the front. @pre i <= measured(), i < room()
    [[nodiscard]] PlannedCell<S>& at(std::size_t i) noexcept { return storage_[ring_index(head_ + i, room())]; }
    [[nodiscard]] const PlannedCell<S>& at(std::size_t i) const noexcept {
        return storage_[ring_index(head_ + i, room())];
    }
    /// Cells of the plan.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Cells of the plan and those that were measured for it.
    [[nodiscard]] std::size_t measured() const noexcept { return measured_; }
    [[nodiscard]] std::size_t room() const noexcept { return storage_.size(); }

    /// at(measured()) has become a measured cell. @pre measured() < room()
    void add_measured() noexcept { ++measured_; }
    /// The plan takes the next measured cell. @pre size() < measured()
    void take() noexcept { ++size_; }
    /// Removes the front cell. @pre size() > 0
    void pop() noexcept {
        SPLINEFEED_ASSERT(size_ > 0);
        head_ = ring_index(head_ + 1, room());
        --size_;
        --measured_;
    }
    void clear() noexcept { size_ = measured_ = 0; }

private:
    std::span<PlannedCell<S>> storage_;
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::size_t measured_ = 0;
};

} // namespace splinefeed
