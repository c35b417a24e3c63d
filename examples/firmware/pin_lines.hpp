// SPDX-License-Identifier: MIT
// PinLines: step and direction lines that the tick's interrupt switches itself.
#pragma once

#include "step_shaper.hpp"

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s5_pulse_train/dda_loader.hpp"

#include <cstdint>

namespace firmware {

using splinefeed::PerAxis;

/// Lines of a StepGenerator: what shows the steps of its ticks. These have all levels of a tick at its begin.
/// @tparam Axes  1 to 6
template <unsigned Axes>
class PinLines {
public:
    using Dda = splinefeed::TickDda<Axes>;
    static constexpr auto samples = splinefeed::DdaLoader::Samples::at_middles;
    static constexpr std::uint32_t counts_in_ticks[2] = {1, 2}; ///< the fastest axis travels less

    [[nodiscard]] static constexpr Dda dda() noexcept { return {}; }

    /// Shows a tick by `write(pins)`, and calls made(axis, steps) for each pulse that begins.
    template <class Write, class Made>
    void show(Write&& write, Made&& made) noexcept {
        write(out_);
        for (unsigned k = 0; out_.step != 0 && k < Axes; ++k) {
            if (((out_.step >> k) & 1U) != 0) {
                made(k, ((out_.up >> k) & 1U) != 0 ? 1 : -1);
            }
        }
    }
    /// The steps of a tick. @param moving  more will come
    template <class Made>
    void take(splinefeed::StepBits steps, bool /*moving*/, Made&& /*made*/) noexcept {
        out_ = shaper_.next(steps);
    }

    /// No pulse begins any more. `write` takes back what was written and is not shown yet: none is.
    template <class Write>
    PerAxis<std::int32_t> cut(Write&& /*write*/) noexcept {
        shaper_.clear();
        out_.step = 0;
        return {};
    }
    /// Whether all steps are made.
    [[nodiscard]] bool empty() const noexcept { return out_.step == 0 && shaper_.empty(); }

private:
    StepShaper<Axes> shaper_{};
    Pins out_{};
};

} // namespace firmware
