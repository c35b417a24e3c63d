// SPDX-License-Identifier: MIT
// Sampler: the position of the machine, once per segment duration.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"

namespace splinefeed {

/// The samples of a planned motion. At a stop three or more samples are equal.
template <Scalar S>
class Sampler {
public:
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    /// Computes the next sample. `starved`, `held`, `busy` and `finished`: there is none, and nothing was lost.
    virtual Pull next(UnderrunPolicy underrun, WorkBudget& work) noexcept = 0;
    /// Whether this sample is the last one of a motion.
    [[nodiscard]] virtual bool at_rest() const noexcept = 0;
    /// Forgets the path so far, for a new program. @pre at_rest()
    virtual void clear() noexcept = 0;

    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return position_; }
    /// The position where the first motion started. @pre next() answered item or held
    [[nodiscard]] const PerAxis<Position>& origin() const noexcept { return origin_; }
    /// Index of the waypoint that the sample leads to.
    [[nodiscard]] std::uint32_t waypoint() const noexcept { return waypoint_; }

protected:
    Sampler() noexcept = default;
    ~Sampler() = default;

    PerAxis<Position> position_{};
    PerAxis<Position> origin_{};
    std::uint32_t waypoint_ = 0;
};

} // namespace splinefeed
