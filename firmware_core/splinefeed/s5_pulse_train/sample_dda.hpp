// SPDX-License-Identifier: MIT
// SampleDda: samples of the motion by additions, and the steps on the lines between them.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/tick_part.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace splinefeed {

/// The steps of an axis between two ticks, at equal intervals. Instants are in 1/8 us from the first tick.
struct LineSteps {
    std::uint32_t count = 0;    ///< that are left
    bool up = false;            ///< all of them
    std::uint32_t at = 0;       ///< of the next one, and a half [2^-16]
    std::uint32_t interval = 0; ///< [2^-16]

    [[nodiscard]] constexpr std::uint32_t instant() const noexcept { return at >> 16; }
    /// Goes to the next one. @pre count > 0
    constexpr void advance() noexcept {
        --count;
        at += interval;
    }

    static constexpr int count_shift = 60; ///< of the positions: modulo 16 counts

    /// Where the line between two positions passes counts. Steps are at most half of 1/8 us and a fortieth of it from
    /// the line, and never behind the second tick. Cost: a division of 32 by 16 bits.
    /// @pre the positions are less than 8 counts apart; tick_ticks <= 8000
    [[nodiscard]] static constexpr LineSteps between(std::uint64_t position, std::uint64_t next,
                                                     std::uint32_t tick_ticks) noexcept {
        constexpr unsigned places = count_shift - 32;
        constexpr std::uint32_t one = 1U << places;
        const auto from = static_cast<std::uint32_t>(position >> 32);
        const std::uint32_t passed = (static_cast<std::uint32_t>(next >> 32) >> places) - (from >> places);
        const auto counts = static_cast<std::int32_t>(passed << places) >> places;
        if (counts == 0) {
            return {};
        }
        const auto way = static_cast<std::int32_t>((next - position) >> 32);
        const std::uint32_t length = static_cast<std::uint32_t>(way < 0 ? -way : way) | 1U;
        const std::uint32_t to_first = counts > 0 ? one - from % one : from % one;
        const std::uint32_t ahead = to_first < length ? to_first : length;
        // With 16 digits of both: 1 / length and ahead / length.
        const int zeros = std::countl_zero(length);
        const std::uint32_t inverse = 0xffffffffU / ((length << zeros) >> 16); // 2^16 to 2^17
        const std::uint32_t part = (((ahead << zeros) >> 16) * (inverse >> 1)) >> 15;
        LineSteps steps;
        steps.up = counts > 0;
        steps.count = static_cast<std::uint32_t>(counts > 0 ? counts : -counts);
        steps.at = tick_ticks * (part < 65536 ? part : 65536) + (1U << 15);
        if (steps.count > 1) { // then the line is longer than a count: few zeros
            constexpr int most_zeros = 32 - static_cast<int>(places);
            steps.interval = (tick_ticks * inverse) >> (most_zeros - zeros);
            const std::uint32_t last = steps.at + (steps.count - 1) * steps.interval;
            const std::uint32_t end = (tick_ticks << 16) + (1U << 15);
            steps.at -= last > end ? last - end : 0;
        }
        return steps;
    }
};

/// Needs a new part when left() is zero: DdaLoader makes it, of samples at ticks.
/// @tparam Axes  number of axes that are computed
template <unsigned Axes>
class SampleDda {
public:
    static_assert(Axes >= 1 && Axes <= static_cast<unsigned>(max_axes));
    /// From the tick before to this one, as long as no other function is called; null: none.
    using Steps = const std::array<LineSteps, Axes>*;

    constexpr explicit SampleDda(std::uint32_t tick_ticks) noexcept : tick_ticks_(tick_ticks) {}

    /// Sets the position before the first part.
    constexpr void stand(const PerAxis<std::int32_t>& count) noexcept {
        for (unsigned k = 0; k < Axes; ++k) {
            table_[k].position = middle(count[k]);
        }
    }

    /// Ticks that are left in the part.
    [[nodiscard]] std::uint32_t left() const noexcept { return left_; }

    /// The first tick of a part. @pre left() == 0
    Steps begin(const TickPart& part) noexcept {
        SPLINEFEED_ASSERT(left_ == 0 && part.ticks > 0);
        left_ = part.ticks - 1;
        for (unsigned k = 0; k < Axes; ++k) {
            steps_[k] = LineSteps::between(table_[k].position, part.table[k].position, tick_ticks_);
            table_[k] = part.table[k];
        }
        return &steps_;
    }

    /// Every other tick. @pre left() > 0
    Steps tick() noexcept {
        SPLINEFEED_ASSERT(left_ > 0);
        --left_;
        for (unsigned k = 0; k < Axes; ++k) {
            DifferenceTable& table = table_[k];
            const std::uint64_t position = table.position;
            table.position += table.first;
            table.first += table.second;
            table.second += table.third;
            steps_[k] = LineSteps::between(position, table.position, tick_ticks_);
        }
        return &steps_;
    }

    /// At the end of all motion: the steps that are missing to these counts. @pre each axis is a few counts away
    Steps finish(const PerAxis<std::int32_t>& count) noexcept {
        for (unsigned k = 0; k < Axes; ++k) {
            // As the motion would go on, if that leads there.
            const std::uint64_t end = middle(count[k]);
            const std::uint64_t next = table_[k].position + table_[k].first;
            const bool leads_there = (next >> LineSteps::count_shift) == (end >> LineSteps::count_shift);
            steps_[k] = LineSteps::between(table_[k].position, leads_there ? next : end, tick_ticks_);
            table_[k].position = end;
        }
        return &steps_;
    }

private:
    /// Half a count is added to positions, as DifferenceTable says.
    [[nodiscard]] static constexpr std::uint64_t middle(std::int32_t count) noexcept {
        constexpr std::uint64_t half = std::uint64_t{1} << (LineSteps::count_shift - 1);
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(count)) << LineSteps::count_shift) + half;
    }

    std::array<DifferenceTable, Axes> table_{};
    std::array<LineSteps, Axes> steps_{};
    std::uint32_t left_ = 0;
    std::uint32_t tick_ticks_;
};

} // namespace splinefeed
