// SPDX-License-Identifier: MIT
// CurveFilter: what a curve passes on its way to the plan, and who may end it there.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed {

/// Passes the segments of another source on, one by one.
template <Scalar S>
class CurveFilter : public CurveSource<S> {
public:
    /// `source` begins, and must outlive it; what it did before is forgotten.
    virtual void begin(CurveSource<S>& source) noexcept = 0;
    /// Whether it has refused a segment. It passes no more on.
    [[nodiscard]] virtual bool has_ended() const noexcept = 0;
};

} // namespace splinefeed
