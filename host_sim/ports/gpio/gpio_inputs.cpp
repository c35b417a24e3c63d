// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_inputs.hpp"

#include "host_sim/ports/run_target.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using hal::gpio::InputRole;
using hal::gpio::InputWatch;
using hal::gpio::MappedInput;

const char* role_name(InputRole role) noexcept {
    switch (role) {
    case InputRole::e_stop: return "e-stop";
    case InputRole::limit: return "limit";
    case InputRole::home: return "home";
    case InputRole::drive_fault: return "drive-fault";
    case InputRole::probe: return "probe";
    }
    return "";
}

GpioInputs::GpioInputs(const hal::gpio::LineMap& map, const MachineDescription& machine, GpioLines& chips,
                       hal::gpio::StepPort& port, const hal::gpio::InputWatchSettings& settings)
    : map_(&map), machine_(&machine), chips_(&chips) {
    for (GpioLines::Inputs& inputs : chips.inputs()) {
        std::vector<hal::gpio::WatchedInput> watched;
        for (const std::size_t i : inputs.input) {
            const MappedInput& input = map.inputs[i];
            watched.push_back({.bit = input.line.bit,
                               .active_level = input.active_level,
                               .debounce_us = input.debounce_us,
                               .trips_estop = input.role == InputRole::e_stop});
        }
        auto watch = std::make_unique<InputWatch>(
            *inputs.source, watched, port.log(), [&port] { port.disable(); }, settings);
        if (!watch->start()) {
            throw TargetError("the inputs of {} cannot be read: {}",
                              map.chips[map.inputs[inputs.input.front()].line.chip].chip, watch->trouble());
        }
        watched_.push_back({std::move(inputs.input), std::move(watch)});
    }
}

std::optional<SwitchChange> GpioInputs::take() {
    for (const Chip& chip : watched_) {
        if (const auto change = chip.watch->take()) {
            return SwitchChange{chip.input[change->input], change->active, change->time_ns, change->counts};
        }
    }
    return std::nullopt;
}

bool GpioInputs::active(std::size_t input) const {
    for (const Chip& chip : watched_) {
        if (const auto at = std::ranges::find(chip.input, input); at != chip.input.end()) {
            return chip.watch->active(static_cast<std::size_t>(at - chip.input.begin()));
        }
    }
    return false;
}

std::optional<std::size_t> GpioInputs::pressed() const {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        if (map_->inputs[i].role == InputRole::e_stop && active(i)) {
            return i;
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> GpioInputs::home_of(int axis) const {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        if (map_->inputs[i].role == InputRole::home && map_->inputs[i].axis == axis) {
            return i;
        }
    }
    return std::nullopt;
}

std::string GpioInputs::in_the_way(bool limits) const {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const InputRole role = map_->inputs[i].role;
        const bool stops =
            role == InputRole::e_stop || role == InputRole::drive_fault || (limits && role == InputRole::limit);
        if (stops && active(i)) {
            return fmt::format("the {} acts; {}", name(i),
                               role == InputRole::limit ? "move the axis off it by hand, or find the references with "
                                                          "--home"
                               : role == InputRole::e_stop ? "release it"
                                                           : "see what the drive shows");
        }
    }
    return {};
}

std::string GpioInputs::name(std::size_t input) const {
    const MappedInput& mapped = map_->inputs[input];
    const std::string of =
        mapped.axis >= 0 ? " of axis " + machine_->axis_name[static_cast<unsigned>(mapped.axis)] : "";
    return fmt::format("{}{} ({})", role_name(mapped.role), of, chips_->name(mapped.line));
}

std::string GpioInputs::trouble() const {
    for (const Chip& chip : watched_) {
        if (const std::string what = chip.watch->trouble(); !what.empty()) {
            return fmt::format("the inputs of {} are not heard any more: {}",
                               map_->chips[map_->inputs[chip.input.front()].line.chip].chip, what);
        }
    }
    return {};
}

std::uint64_t GpioInputs::missed() const {
    std::uint64_t sum = 0;
    for (const Chip& chip : watched_) {
        sum += chip.watch->missed();
    }
    return sum;
}

} // namespace splinefeed::host
