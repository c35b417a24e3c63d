// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/catmull_rom.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
void CatmullRom<S>::find_tangent(std::uint64_t i, bool from_before, bool from_after,
                                 KnotTangent<S>& out) const noexcept {
    SpannedChord<S> before;
    SpannedChord<S> after;
    if (from_before) {
        const Knot<S>& knot = this->knot(i - 1);
        before = {&knot.chord, knot.span};
    }
    if (from_after) {
        const Knot<S>& knot = this->knot(i);
        after = {&knot.chord, knot.span};
    }
    catmull_rom_tangent(before, after, tension_, this->axes(), out);
}

template <Scalar S>
Pull CatmullRom<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        const std::uint64_t i = next_;
        if (const Pull ready = this->ready(i); ready != Pull::item) {
            return ready;
        }
        next_ = i + 1;
        this->oldest_ = i;
        if (this->travelled(i)) {
            this->describe_segment(i, 3, out);
            const Knot<S>& here = this->knot(i);
            KnotTangent<S>& start = tangents_[i % 2];
            KnotTangent<S>& end = tangents_[(i + 1) % 2];
            if (here.breaks || ends_at_ != i) {
                find_tangent(i, !here.breaks, true, start);
            }
            find_tangent(i + 1, true, !this->knot(i + 1).breaks, end);
            ends_at_ = i + 1;
            Point<S> leg_in{};
            Point<S> leg_out{};
            catmull_rom_legs<S>({&here.chord, here.span}, start, end, this->axes(), leg_in, leg_out);
            PerAxis<PerDegree<S>> offsets{};
            for (const unsigned k : indices(this->axes())) {
                offsets[k][1] = leg_in[k];
                offsets[k][2] = leg_out[k];
                offsets[k][3] = here.chord[k];
            }
            out.assign(offsets);
            return Pull::item;
        }
    }
}

SPLINEFEED_INSTANTIATE_CLASS(CatmullRom)

} // namespace splinefeed
