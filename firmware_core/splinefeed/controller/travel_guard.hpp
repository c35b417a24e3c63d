// SPDX-License-Identifier: MIT
// TravelGuard: ends a curve before the first segment that leaves the travel of the machine.
#pragma once

#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s1_curve/curve_filter.hpp"

namespace splinefeed {

/// The same law as that of a run (travel_allowance_mm). Cost: a comparison for each Bezier point; near the end of
/// travel a segment is halved until it is decided.
template <Scalar S>
class TravelGuard final : public CurveFilter<S> {
public:
    /// `travel` must outlive it.
    TravelGuard(const PerAxis<AxisTravel>& travel, int axes) noexcept : travel_(&travel), axes_(axes) {}

    void begin(CurveSource<S>& source) noexcept override {
        source_ = &source;
        ended_ = false;
    }
    Pull next(CurveSegment<S>& out) noexcept override;
    /// Whether it has met such a segment. From then on it is starved.
    [[nodiscard]] bool has_ended() const noexcept override { return ended_; }

private:
    [[nodiscard]] bool leaves(const CurveSegment<S>& segment) const noexcept;

    CurveSource<S>* source_ = nullptr;
    const PerAxis<AxisTravel>* travel_;
    int axes_;
    bool ended_ = false;
};

} // namespace splinefeed
