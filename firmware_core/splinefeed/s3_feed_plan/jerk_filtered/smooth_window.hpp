// SPDX-License-Identifier: MIT
// SmoothWindow: the cells that a SmoothPlan knows, with the limits of each.
//
//        behind            front           prepared            back
//      |___|___|___|___|___|___|___|___|___|___|___|___|___|___|
//          ^ the machine   ^ the motion that is averaged  ^ not yet known far enough ahead
#pragma once

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/number/path_position.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/filtered_limits.hpp"

#include <span>

namespace splinefeed {

/// A cell of the window, in storage of the caller. Speeds are v^2 [mm^2/s^2].
template <Scalar S>
struct SmoothCell {
    Cell<S> cell{};
    PathPosition start{}; ///< where it starts on the path
    S bound_sq{};         ///< at its start: upper bound for every motion, whatever the steering
    S bound_ticks{};      ///< least time for the cell
    PathDerivativeBounds<S> own{};
    PathDerivativeBounds<S> demand{}; ///< bounds over all places where the average can be while the motion is in this
                                      ///< cell
    std::uint32_t smoothing_q8 = 0;
    S max_path_acceleration{};    ///< FilteredLimits::max_path_acceleration
    S max_steady_sq{};            ///< largest v^2 that may be held constant in it
    S machine_controllable_sq{};  ///< largest v^2 at its start from which the end of the known path can be reached at
                                  ///< standstill
    S override_controllable_sq{}; ///< the same, with the speeds that the steering wants
    S override_reach{};           ///< override_controllable_sq if only this cell counted
};

/// A ring of cells; all indices count from the oldest.
template <Scalar S>
class SmoothWindow {
public:
    SmoothWindow(const MotionLimits<S>& limits, std::span<SmoothCell<S>> storage) noexcept
        : limits_(&limits), storage_(storage) {}

    [[nodiscard]] SmoothCell<S>& at(std::size_t i) noexcept { return storage_[ring_index(head_ + i, storage_.size())]; }
    [[nodiscard]] const SmoothCell<S>& at(std::size_t i) const noexcept {
        return storage_[ring_index(head_ + i, storage_.size())];
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t front() const noexcept { return front_; }
    [[nodiscard]] std::size_t prepared() const noexcept { return prepared_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return storage_.size(); }
    /// Whether append() may be called.
    [[nodiscard]] bool has_room() const noexcept { return size_ + 2 < storage_.size(); }
    /// Whether the motion comes to standstill at the end of the cell, whatever the steering wants.
    [[nodiscard]] bool ends_leg(std::size_t i) const noexcept { return !(bound_behind(i) > S{}); }

    /// Appends a cell, with a stop before it if q'' jumps there. @param exit_bound_sq  upper bound of v^2 at its end
    void append(const Cell<S>& cell, S cap_sq, S programmed_sq, S exit_bound_sq) noexcept;
    /// The motion comes to standstill at the end of the known path, whatever comes after it.
    void end_here() noexcept;
    /// Prepares the cells after which enough of the path is known.
    /// @param force  prepares at least half of the cells, up to the next leg. If there is no room to know more of the
    ///               path, the motion becomes so slow that it needs no more.
    void prepare(bool force) noexcept;
    /// Call it when the motion (not its average) leaves the front cell.
    void pass_front() noexcept { ++front_; }
    /// Call it when the machine leaves the oldest cell. @pre front() > 0
    void release() noexcept;
    void clear() noexcept;

private:
    [[nodiscard]] S bound_behind(std::size_t i) const noexcept {
        return i + 1 < size_ ? at(i + 1).bound_sq : end_bound_sq_;
    }
    [[nodiscard]] bool bend_jumps(const Cell<S>& before, const Cell<S>& after, S speed_sq) const noexcept;
    void split_last() noexcept;
    [[nodiscard]] bool starts_leg(std::size_t i) const noexcept { return !(at(i).bound_sq > S{}); }
    [[nodiscard]] std::uint32_t smoothing_of_leg(std::size_t first, bool& in_view) const noexcept;
    [[nodiscard]] bool last_reached(std::size_t i, const Smoothing<S>& smoothing, std::size_t& last) const noexcept;
    [[nodiscard]] std::size_t first_reached(std::size_t i, const Smoothing<S>& smoothing) const noexcept;
    void slow_down(std::size_t first) noexcept;
    void measure(std::size_t i) noexcept {
        SmoothCell<S>& here = at(i);
        here.bound_ticks = quotient_or_max(here.cell.length_mm * limits_->segments_per_s,
                                           square_root(larger(here.bound_sq, bound_behind(i))));
    }
    void tighten(std::size_t first) noexcept;
    [[nodiscard]] PathDerivativeBounds<S> demand_of(std::size_t first, std::size_t last) noexcept;

    const MotionLimits<S>* limits_;
    std::span<SmoothCell<S>> storage_;
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::size_t front_ = 0;
    std::size_t prepared_ = 0; // cells from the oldest on
    PathPosition end_{};       // end of the known path
    S end_bound_sq_{};         // bound of v^2 there
    Smoothing<S> smoothing_{}; // of the leg that is being prepared
    std::size_t bounded_ = 0;  // cells from the oldest on that have a bound from the leg itself
    // Maxima over a window of cells that only moves forward. `own` of each cell from low_ to middle_ holds the maximum
    // of all cells from there to middle_. joined_ holds that of the cells from middle_ to high_.
    std::size_t low_ = 0;
    std::size_t middle_ = 0;
    std::size_t high_ = 0;
    PathDerivativeBounds<S> joined_{};
};

} // namespace splinefeed
