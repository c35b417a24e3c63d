// SPDX-License-Identifier: MIT
// SlotMaker: from where the axes are at the ends of slots to what the interrupt makes steps of.
#pragma once

#include "drive/path_motion.hpp"

#include "splinefeed/s5_pulse_train/dda_loader.hpp"

#include <optional>

namespace firmware {

class SlotMaker {
public:
    /// The next slot begins at this position, at standstill.
    void stand_at(const PerAxis<std::int64_t>& position) noexcept;
    /// The slot from the end of the one before to these places. `rest`: the axes stand there. Returns the axis that is
    /// too fast for the ticks, and then makes nothing.
    [[nodiscard]] std::optional<unsigned> make(const AxisPlaces& to, bool rest, MotionPart& out) noexcept;
    /// Where the last slot ends.
    [[nodiscard]] const AxisPlaces& reference() const noexcept { return reference_; }

private:
    splinefeed::DdaLoader loader_{static_cast<int>(drive_axes), drive_tick_us * 8};
    AxisPlaces reference_;
};

} // namespace firmware
