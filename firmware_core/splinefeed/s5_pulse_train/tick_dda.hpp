// SPDX-License-Identifier: MIT
// TickDda: the work of the timer interrupt: three additions per axis and tick.
//
//   position += first,   first += second,   second += third
//
// A change of the position's two highest bits is a step.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/tick_part.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace splinefeed {

/// The steps of one tick: bit 2k is set if axis k steps, bit 2k + 1 if it steps down.
struct StepBits {
    std::uint32_t bits = 0;

    [[nodiscard]] constexpr bool steps(unsigned axis) const noexcept { return ((bits >> (2 * axis)) & 1U) != 0; }
    [[nodiscard]] constexpr bool up(unsigned axis) const noexcept { return ((bits >> (2 * axis)) & 3U) == 1; }
};

/// Needs a new part when left() is zero; DdaLoader makes it meanwhile, outside the interrupt. No branch depends on the
/// motion. Cost: docs/explanation/pulse_train.md.
/// @tparam Axes  number of axes that are computed
template <unsigned Axes>
class TickDda {
public:
    static_assert(Axes >= 1 && Axes <= static_cast<unsigned>(max_axes));
    using Steps = StepBits;

    /// Sets the position before the first part.
    constexpr void stand(const PerAxis<std::int32_t>& count) noexcept {
        for (unsigned k = 0; k < Axes; ++k) {
            table_[k].position = top(count[k]);
        }
    }

    /// Ticks that are left in the part.
    [[nodiscard]] std::uint32_t left() const noexcept { return left_; }

    /// The first tick of a part. @pre left() == 0
    StepBits begin(const TickPart& part) noexcept {
        SPLINEFEED_ASSERT(left_ == 0 && part.ticks > 0);
        left_ = part.ticks - 1;
        StepBits steps;
        for (unsigned k = 0; k < Axes; ++k) {
            steps.bits |= difference(part.table[k].position, table_[k].position) << (2 * k);
            table_[k] = part.table[k];
        }
        return steps;
    }

    /// Every other tick. @pre left() > 0
    StepBits tick() noexcept {
        SPLINEFEED_ASSERT(left_ > 0);
        --left_;
        return all(std::make_integer_sequence<unsigned, Axes>{});
    }

    /// At the end of all motion: the steps that are missing to whole counts. @pre each axis is at most one count away
    StepBits finish(const PerAxis<std::int32_t>& count) noexcept {
        StepBits steps;
        for (unsigned k = 0; k < Axes; ++k) {
            std::uint64_t& position = table_[k].position;
            steps.bits |= difference(top(count[k]), position) << (2 * k);
            position = top(count[k]);
        }
        return steps;
    }

private:
    [[nodiscard]] static constexpr std::uint64_t top(std::int32_t count) noexcept {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(count)) << DifferenceTable::count_shift;
    }
    /// Counts from one position to the next, modulo 4: 0, 1 or 3.
    [[nodiscard]] static constexpr std::uint32_t difference(std::uint64_t next, std::uint64_t position) noexcept {
        constexpr std::uint32_t whole = 3U << (DifferenceTable::count_shift - 32);
        const auto high = static_cast<std::uint32_t>(next >> 32);
        return (high - (static_cast<std::uint32_t>(position >> 32) & whole)) >> (DifferenceTable::count_shift - 32);
    }
    [[nodiscard, gnu::always_inline]] static constexpr std::uint32_t add(DifferenceTable& table) noexcept {
        const std::uint64_t position = table.position;
        const std::uint64_t first = table.first;
        const std::uint64_t second = table.second;
        table.position = position + first;
        table.first = first + second;
        table.second = second + table.third;
        return difference(position + first, position);
    }
    // Written out, for compilers that do not unroll loops when they optimise for size.
    template <unsigned... K>
    [[nodiscard]] constexpr StepBits all(std::integer_sequence<unsigned, K...> /*axes*/) noexcept {
        StepBits steps;
        ((steps.bits |= add(table_[K]) << (2 * K)), ...);
        return steps;
    }

    std::array<DifferenceTable, Axes> table_{};
    std::uint32_t left_ = 0;
};

} // namespace splinefeed
