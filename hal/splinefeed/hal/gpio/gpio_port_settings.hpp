// SPDX-License-Identifier: MIT
// GpioPortSettings: what a GpioPort knows of its machine, beside the map of its lines.
#pragma once

#include "splinefeed/hal/gpio/step_port.hpp"
#include "splinefeed/hal/stop_sequence.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"

#include <string>

namespace splinefeed::hal::gpio {

struct GpioPortSettings {
    MachineSettings machine{};        ///< limits, which its own moves keep, too
    PerAxis<std::string> axis_name{}; ///< for messages
    PerAxis<double> search_mm{};      ///< how far an axis searches its home switch
    StepPortSettings step{};
    StopTimes stop{};
    bool drives_on_at_end = false;
    bool ends_at_probe = false; ///< each motion ends, held on the path, when the probe touches
    /// Polled while axes find their references; true: the search ends.
    bool (*interrupted)() = [] {
        return false;
    };

    /// Where the segment begins. [mm]
    [[nodiscard]] double begin_mm(unsigned axis, const FeedSegment& segment) const noexcept {
        return static_cast<double>(segment.start[axis]) / static_cast<double>(units_per_count) /
               machine.axis[axis].steps_per_mm;
    }
    /// Where an axis is at a count. [mm]
    [[nodiscard]] double mm_of(unsigned axis, std::int64_t count) const noexcept {
        return static_cast<double>(count) / machine.axis[axis].steps_per_mm;
    }
};

/// For messages, rounded to 0.1 um: "96", "0.1125".
[[nodiscard]] std::string mm_text(double mm);

} // namespace splinefeed::hal::gpio
