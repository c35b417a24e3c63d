// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/catmull_rom.hpp"

namespace splinefeed {

template <Scalar S>
PerAxis<S> CatmullRom<S>::slope(std::uint64_t i, bool from_before, bool from_after) const noexcept {
    PerAxis<S> out{};
    const Knot<S>& before = this->knot(i - (from_before ? 1U : 0U));
    const Knot<S>& here = this->knot(i);
    const S weight = from_before && from_after ? before.span / (before.span + here.span) : S{};
    for (unsigned k = 0; k < static_cast<unsigned>(this->axes()); ++k) {
        if (from_before && from_after) {
            const S left = before.chord[k] / before.span;
            const S right = here.chord[k] / here.span;
            out[k] = (left + weight * (right - left)) * (tension_ + tension_);
            // weight belongs to the later chord: h_{i-1}/(h_{i-1}+h_i)
        } else if (from_before) {
            out[k] = before.chord[k] / before.span * tension_;
        } else {
            out[k] = here.chord[k] / here.span * tension_;
        }
    }
    return out;
}

template <Scalar S>
Pull CatmullRom<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        const std::uint64_t i = next_;
        if (i + 1 >= this->known_) {
            return this->finished_ ? Pull::finished : Pull::starved;
        }
        if (!this->decided(i + 1)) {
            return Pull::starved;
        }
        next_ = i + 1;
        this->oldest_ = i;
        if (this->travelled(i)) {
            this->describe_segment(i, 3, out);
            const Knot<S>& from = this->knot(i);
            const Knot<S>& to = this->knot(i + 1);
            const PerAxis<S> start = slope(i, !from.breaks, true);
            const PerAxis<S> end = slope(i + 1, true, !to.breaks);
            const S reach = from.span / from_integer<S>(3);
            PerAxis<PerDegree<S>> offsets{};
            for (unsigned k = 0; k < static_cast<unsigned>(this->axes()); ++k) {
                offsets[k][1] = start[k] * reach;
                offsets[k][2] = from.chord[k] - end[k] * reach;
                offsets[k][3] = from.chord[k];
            }
            out.assign(offsets);
            return Pull::item;
        }
    }
}

template class CatmullRom<double>;
template class CatmullRom<float>;
template class CatmullRom<Fixed>;

} // namespace splinefeed
