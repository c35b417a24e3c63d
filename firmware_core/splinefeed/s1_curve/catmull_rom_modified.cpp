// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
Chord<S> CatmullRomModified<S>::chord(std::uint64_t i) const noexcept {
    const Knot<S>& knot = this->knot(i);
    Chord<S> out{{}, knot.length};
    for (const unsigned k : indices(this->axes())) {
        out.vector[k] = knot.chord[k];
    }
    return out;
}

template <Scalar S>
Point<S> CatmullRomModified<S>::start_slope(std::uint64_t i) const noexcept {
    if (!this->knot(i).breaks) {
        return central_slope(chord(i - 1), chord(i));
    }
    return this->knot(i + 1).breaks ? only_slope(chord(i)) : left_slope(chord(i), chord(i + 1));
}

template <Scalar S>
Point<S> CatmullRomModified<S>::end_slope(std::uint64_t i) const noexcept {
    if (!this->knot(i + 1).breaks) {
        return central_slope(chord(i), chord(i + 1));
    }
    return this->knot(i).breaks ? only_slope(chord(i)) : right_slope(chord(i - 1), chord(i));
}

template <Scalar S>
Pull CatmullRomModified<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        const std::uint64_t i = next_;
        if (const Pull ready = this->ready(i); ready != Pull::item) {
            return ready;
        }
        next_ = i + 1;
        this->oldest_ = i;
        if (this->travelled(i)) {
            this->describe_segment(i, 3, out);
            Point<S> leg_in{};
            Point<S> leg_out{};
            modified_legs(chord(i), start_slope(i), end_slope(i), tangents_, leg_in, leg_out);
            PerAxis<PerDegree<S>> offsets{};
            for (const unsigned k : indices(this->axes())) {
                offsets[k][1] = leg_in[k];
                offsets[k][2] = leg_out[k];
                offsets[k][3] = this->knot(i).chord[k];
            }
            out.assign(offsets);
            return Pull::item;
        }
    }
}

SPLINEFEED_INSTANTIATE_CLASS(CatmullRomModified)

} // namespace splinefeed
