// SPDX-License-Identifier: MIT
// Sampler: where the machine is, once per segment duration.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s3_feed_plan/steering/motion_plan.hpp"

namespace splinefeed {

/// The samples of a planned motion. At a stop there are three that are the same, or more.
template <Scalar S>
class Sampler {
public:
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    /// Takes the next sample. `starved`, `held` and `finished`: there is none, and nothing was lost.
    virtual Pull next(UnderrunPolicy underrun) noexcept = 0;
    /// The sample is the last of a motion.
    [[nodiscard]] virtual bool at_rest() const noexcept = 0;
    /// The path before is done with: for a new program. @pre at_rest()
    virtual void clear() noexcept = 0;

    [[nodiscard]] const PerAxis<Position>& position() const noexcept { return position_; }
    /// Where the first motion started. @pre next() answered item or held
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
