// SPDX-License-Identifier: MIT
// SwitchStops: which limits and drive faults stop the motion, and limits that axes may leave.
#pragma once

#include "splinefeed/hal/gpio/switch_inputs.hpp"

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <array>
#include <optional>
#include <vector>

namespace splinefeed::hal::gpio {

/// A limit that an axis has run into acts until the axis is moved off it. let_leave() permits that: the limit may go on
/// acting until it lets go, and its axis does not go further the way that it came.
class SwitchStops {
public:
    /// All must outlive it.
    SwitchStops(const GpioPortSettings& settings, const PinMap& map, const SwitchInputs& inputs)
        : settings_(&settings), map_(&map), inputs_(&inputs), leaving_(map.inputs.size()) {}

    /// Each millisecond. @param counts  of the port
    void follow(const PerAxis<std::int64_t>& counts, std::uint64_t now_us);
    /// Whether a change stops the motion.
    [[nodiscard]] bool stops(const InputChange& change);
    /// The first limit or drive fault that acts, and may not; nothing: there is none.
    [[nodiscard]] std::optional<std::size_t> acting();
    /// The limit that this piece of motion would go further into; nothing: there is none.
    [[nodiscard]] std::optional<std::size_t> led_into(const FeedSegment& segment) const;
    void let_leave();

private:
    /// Of an axis.
    struct Way {
        std::int64_t count = 0;
        std::uint64_t changed_us = 0;
        int direction = 0;
    };
    /// Of an input.
    struct Leaving {
        bool may = false;        // it may act
        bool acted = false;      // when it was looked at last
        int came = 0;            // direction in which its axis went when it began to act; 0: none
        std::int64_t let_go = 0; // where its axis was then
    };

    [[nodiscard]] bool is_limit(std::size_t input) const { return map_->inputs[input].role == InputRole::limit; }
    void look(std::size_t input, bool active);

    const GpioPortSettings* settings_;
    const PinMap* map_;
    const SwitchInputs* inputs_;
    std::array<Way, max_axes> way_{};
    std::vector<Leaving> leaving_; // as the inputs
    std::uint64_t now_us_ = 0;
};

} // namespace splinefeed::hal::gpio
