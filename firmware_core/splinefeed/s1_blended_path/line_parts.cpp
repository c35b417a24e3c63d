// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/line_parts.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

namespace {

constexpr double least_part = 0.25; // chord units, 6e-5 mm: a shorter one is no segment of its own

} // namespace

template <Scalar S>
bool pass_part(LineParts& parts, const PerAxis<Position>& here, int axes, PerAxis<Position>& there,
               std::uint32_t& index) noexcept {
    while (const LinePart* const part = parts.next_before(index)) {
        PerAxis<S> along = distances<S>(here, there, chord_unit_log2, axes);
        const S length = norm(along, axes);
        divide(along, length, axes);
        const S way = dot(distances<S>(here, part->place, chord_unit_log2, axes), along, axes);
        if (way > length - literal<S>(least_part)) {
            return false;
        }
        const std::uint32_t its = part->index;
        parts.pass();
        if (way > literal<S>(least_part)) {
            there = each(axes, [&](unsigned k) { return displaced(here[k], way * along[k], chord_unit_log2); });
            index = its;
            return true;
        }
    }
    return false;
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template bool pass_part<S>(LineParts&, const PerAxis<Position>&, int, PerAxis<Position>&, std::uint32_t&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
