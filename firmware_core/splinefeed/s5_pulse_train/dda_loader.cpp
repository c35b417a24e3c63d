// SPDX-License-Identifier: MIT
//
// At the first sample of a part, x = u, the cubic is expanded again,
//
//   p(x + h) = p(x) + b1 h + b2 h^2 + b3 h^3,   b3 = third,  b2 = second + 3 third x,  b1 = p'(x),
//
// and with r = tick / duration the differences are
//
//   first = b1 r + b2 r^2 + b3 r^3,   second = 2 b2 r^2 + 6 b3 r^3,   third = 6 b3 r^3,
//
// in units of 2^-62 count; a position unit has 2^32 / 3 of them. Coefficients have 8 bits below the unit (none reaches
// 2^62, see AxisCubic). Rounding of b1, b2, b3 and p(x), at most four halves of such a bit each, moves the positions of
// the part by less than 8 bits: 2^-5 unit, 2^-36.5 count. The scales have 62 good bits, and products are rounded to the
// nearest 2^-62 count. So the error of third is e3 <= 1/2, of second e2 <= 2, of first e1 <= 10 (the scales' 2^-60 of
// half a count are 8), and after n ticks that of the position is
//
//   n e1 + n^2/2 e2 + n^3/6 e3  <  2^13.4 + 2^20 + 2^26.5 < 2^27   for n = 1024:  2^-35 count.
//
// In total below 2^-34.5 count. Positions for SampleDda have two bits less below the count, and velocities are up to
// sixteen times as large, with 8 times the error e1: below 2^-32 count.
#include "splinefeed/s5_pulse_train/dda_loader.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace splinefeed {

namespace {

constexpr int below_unit = 8; // bits that coefficients have below the unit
// 2^32 / 3 / 2^8
constexpr UnitScale position_scale{0xaaaaaaaaaaaaaaabU, 41};

static_assert(units_per_count == 3 * (std::int64_t{1} << 30), "position_scale: 2^62 / units_per_count / 2^below_unit");

/// floor(units / units_per_count), without a 64-bit division. @pre |units| < 2^60
std::int32_t whole_counts(std::int64_t units) noexcept {
    const auto thirds = static_cast<std::int32_t>(units >> 30);
    return thirds / 3 - (thirds % 3 < 0 ? 1 : 0);
}

} // namespace

void DdaLoader::take(const FeedSegment& segment) noexcept {
    SPLINEFEED_ASSERT(segment.duration_ticks > 1 && sample_ >= duration_);
    sample_ -= duration_;
    if (segment.duration_ticks != duration_) {
        duration_ = segment.duration_ticks;
        const UnitScale r = UnitScale::ratio(tick_ticks_, duration_);
        scale_[0] = position_scale.times(r);
        scale_[0].shift += DifferenceTable::count_shift - count_shift_;
        scale_[1] = scale_[0].times(r);
        scale_[2] = scale_[1].times(r);
    }
    for (unsigned k = 0; k < axes_; ++k) {
        cubic_[k] = AxisCubic::of(segment, k);
        const std::int64_t way = segment.end[k] - segment.start[k];
        if (!started_) {
            end_count_[k] = static_cast<std::int32_t>(nearest_step(segment.start[k]));
            end_rest_[k] = segment.start[k] - end_count_[k] * units_per_count;
        }
        count_[k] = end_count_[k];
        rest_[k] = end_rest_[k];
        const std::int64_t end = rest_[k] + way;
        const std::int32_t counts = whole_counts(end + units_per_count / 2);
        end_count_[k] = count_[k] + counts;
        end_rest_[k] = end - counts * units_per_count;
    }
    started_ = true;
}

bool DdaLoader::next(TickPart& out) noexcept {
    if (sample_ >= duration_) {
        return false;
    }
    const std::uint32_t samples = (duration_ - sample_ - 1) / tick_ticks_ + 1;
    out.ticks = samples < longest ? samples : longest;
    const std::uint64_t u = divide(Wide{sample_, 0}, duration_).quotient;
    for (unsigned k = 0; k < axes_; ++k) {
        prepare(k, u, out);
    }
    sample_ += out.ticks * tick_ticks_;
    return true;
}

void DdaLoader::prepare(unsigned axis, std::uint64_t u, TickPart& out) const noexcept {
    const std::int64_t a1 = cubic_[axis].first << below_unit;
    const std::int64_t a2 = cubic_[axis].second << below_unit;
    const std::int64_t b3 = cubic_[axis].third << below_unit;
    const std::int64_t third_u = times_q64(b3, u);
    const std::int64_t b2 = a2 + 3 * third_u;
    const std::int64_t b1 = a1 + times_q64(a2 + b2, u);
    const std::int64_t way = times_q64(a1 + times_q64(a2 + third_u, u), u);

    const std::int64_t place = ((rest_[axis] + units_per_count / 2) << below_unit) + way;
    const std::int32_t counts = whole_counts(place >> below_unit);
    const auto rest = static_cast<std::uint64_t>(place - (counts * units_per_count << below_unit));
    // rest * 2^24 / 3
    DifferenceTable& table = out.table[axis];
    table.position =
        (multiply(rest << 24, position_scale.mantissa).high >> (1 + DifferenceTable::count_shift - count_shift_)) |
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(count_[axis] + counts)) << count_shift_;
    const auto cube = static_cast<std::uint64_t>(scaled_by(b3, scale_[2]));
    table.third = static_cast<std::uint64_t>(scaled_by(6 * b3, scale_[2]));
    table.second = static_cast<std::uint64_t>(scaled_by(2 * b2, scale_[1])) + table.third;
    table.first = static_cast<std::uint64_t>(scaled_by(b1, scale_[0])) +
                  static_cast<std::uint64_t>(scaled_by(b2, scale_[1])) + cube;
}

} // namespace splinefeed
