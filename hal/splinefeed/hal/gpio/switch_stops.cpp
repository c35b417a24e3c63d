// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/switch_stops.hpp"

#include <cstdlib>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::uint64_t slow_us = 100'000; // an axis without a step for so long stands

bool stopping(InputRole role) noexcept {
    return role == InputRole::limit || role == InputRole::drive_fault;
}

} // namespace

void SwitchStops::follow(const PerAxis<std::int64_t>& counts, std::uint64_t now_us) {
    now_us_ = now_us;
    for (std::size_t k = 0; k < way_.size(); ++k) {
        Way& way = way_[k];
        if (counts[k] != way.count) {
            way = {counts[k], now_us, counts[k] > way.count ? 1 : -1};
        }
    }
}

// Where it lets go it stops the motion from then on. A switch that bounces there has not changed its side.
void SwitchStops::look(std::size_t input, bool active) {
    constexpr double near_mm = 5.0;
    Leaving& leaving = leaving_[input];
    const int axis = map_->inputs[input].axis;
    if (active != leaving.acted && axis >= 0) {
        const auto k = static_cast<unsigned>(axis);
        const Way& way = way_[k];
        const double away_mm =
            static_cast<double>(std::llabs(way.count - leaving.let_go)) / settings_->machine.axis[k].steps_per_mm;
        const bool moves = way.changed_us > 0 && now_us_ < way.changed_us + slow_us;
        if (!active) {
            leaving.let_go = way.count;
        } else if (leaving.came == 0 || away_mm > near_mm) {
            leaving.came = moves ? way.direction : 0;
        }
    }
    leaving.acted = active;
    leaving.may = leaving.may && active;
}

bool SwitchStops::stops(const InputChange& change) {
    look(change.input, change.active);
    return change.active && stopping(map_->inputs[change.input].role) && !leaving_[change.input].may;
}

std::optional<std::size_t> SwitchStops::acting() {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < leaving_.size(); ++i) {
        look(i, inputs_->active(i));
        if (!first && leaving_[i].acted && stopping(map_->inputs[i].role) && !leaving_[i].may) {
            first = i;
        }
    }
    return first;
}

std::optional<std::size_t> SwitchStops::led_into(const FeedSegment& segment) const {
    for (std::size_t i = 0; i < leaving_.size(); ++i) {
        if (leaving_[i].may && leaving_[i].came != 0) {
            const auto axis = static_cast<unsigned>(map_->inputs[i].axis);
            const std::int64_t way = segment.end[axis] - segment.start[axis];
            if (leaving_[i].came > 0 ? way > 0 : way < 0) {
                return i;
            }
        }
    }
    return std::nullopt;
}

void SwitchStops::let_leave() {
    for (std::size_t i = 0; i < leaving_.size(); ++i) {
        look(i, inputs_->active(i));
        leaving_[i].may = leaving_[i].acted && is_limit(i);
    }
}

} // namespace splinefeed::hal::gpio
