// SPDX-License-Identifier: MIT
// LegLease: the right to search in the one scratch of a window. Who takes it ends the search of who had it.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s3_feed_plan/jerk/leg_plan.hpp"

namespace splinefeed {

template <Floating R>
class LegLease;

/// The one leg that is searched at a time. Only the lease that holds it can touch it.
template <Floating R>
class LegScratch {
public:
    explicit LegScratch(std::span<LegNode<R>> nodes) noexcept : leg_(nodes) {}
    LegScratch(const LegScratch&) = delete;
    LegScratch& operator=(const LegScratch&) = delete;

private:
    friend class LegLease<R>;

    LegPlan<R> leg_;
    const LegLease<R>* holder_ = nullptr;
};

/// Of one who searches now and then. A search runs as long as its lease is held.
template <Floating R>
class LegLease {
public:
    /// `scratch` must outlive it.
    explicit LegLease(LegScratch<R>& scratch) noexcept : scratch_(&scratch) {}
    LegLease(const LegLease&) = delete;
    LegLease& operator=(const LegLease&) = delete;

    void take() noexcept { scratch_->holder_ = this; }
    void give_back() noexcept { scratch_->holder_ = held() ? nullptr : scratch_->holder_; }
    [[nodiscard]] bool held() const noexcept { return scratch_->holder_ == this; }
    /// @pre held(); the same for the next one
    [[nodiscard]] LegPlan<R>* operator->() noexcept {
        SPLINEFEED_ASSERT(held());
        return &scratch_->leg_;
    }
    [[nodiscard]] const LegPlan<R>* operator->() const noexcept {
        SPLINEFEED_ASSERT(held());
        return &scratch_->leg_;
    }

private:
    LegScratch<R>* scratch_;
};

} // namespace splinefeed
