// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/switch_inputs.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace splinefeed::hal::gpio {

namespace {

struct RoleWords {
    const char* name;
    const char* remedy; // where it acts before a motion
};

const RoleWords& words_of(InputRole role) noexcept {
    static constexpr std::array<RoleWords, 5> words{{{"e-stop", "release it"},
                                                     {"limit", "move the axis off it by hand, or home it"},
                                                     {"home", "move the axis off it"},
                                                     {"drive-fault", "see what the drive shows"},
                                                     {"probe", "move it off what it touches"}}};
    return words[static_cast<std::size_t>(role)];
}

} // namespace

const char* role_name(InputRole role) noexcept {
    return words_of(role).name;
}

std::string mm_text(double mm) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), std::round(mm * 1e4) / 1e4);
    return {text.begin(), end.ptr};
}

// Above the thread that makes edges, which may spin: an e-stop must not wait for it.
SwitchInputs::SwitchInputs(const PinMap& map, const GpioPortSettings& settings, MachinePins& lines, StepPort& port)
    : map_(&map), settings_(&settings), lines_(&lines) {
    const int spins = settings.step.real_time.priority;
    for (MachinePins::Inputs& inputs : lines.inputs()) {
        std::vector<WatchedInput> watched;
        for (const std::size_t i : inputs.input) {
            const MappedInput& input = map.inputs[i];
            watched.push_back({.bit = input.line.bit,
                               .active_level = input.active_level,
                               .debounce_us = input.debounce_us,
                               .trips_estop = input.role == InputRole::e_stop});
        }
        auto watch = std::make_unique<InputWatch>(
            *inputs.source, watched, port.log(), [&port] { port.disable(); },
            InputWatchSettings{.priority = spins > 0 ? spins + 1 : 0, .clock = settings.step.clock});
        if (!watch->start()) {
            throw GpioError("the inputs of " + map.chips[map.inputs[inputs.input.front()].line.chip].chip +
                            " cannot be read: " + watch->trouble());
        }
        watched_.push_back({std::move(inputs.input), std::move(watch)});
    }
}

std::optional<InputChange> SwitchInputs::take() {
    for (const Chip& chip : watched_) {
        if (auto change = chip.watch->take()) {
            change->input = chip.input[change->input];
            return change;
        }
    }
    return std::nullopt;
}

bool SwitchInputs::active(std::size_t input) const {
    for (const Chip& chip : watched_) {
        if (const auto at = std::ranges::find(chip.input, input); at != chip.input.end()) {
            return chip.watch->active(static_cast<std::size_t>(at - chip.input.begin()));
        }
    }
    return false;
}

std::optional<std::size_t> SwitchInputs::acting(Roles roles) const {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        if (std::ranges::find(roles, map_->inputs[i].role) != roles.end() && active(i)) {
            return i;
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> SwitchInputs::find(InputRole role, int axis) const {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        if (map_->inputs[i].role == role && map_->inputs[i].axis == axis) {
            return i;
        }
    }
    return std::nullopt;
}

std::string SwitchInputs::acts(std::size_t input) const {
    return "the " + name(input) + " acts; " + words_of(map_->inputs[input].role).remedy;
}

std::string SwitchInputs::in_the_way(Roles roles) const {
    const auto input = acting(roles);
    return input ? acts(*input) : std::string();
}

std::string SwitchInputs::name(std::size_t input) const {
    const MappedInput& mapped = map_->inputs[input];
    const std::string of =
        mapped.axis >= 0 ? " of axis " + settings_->axis_name[static_cast<unsigned>(mapped.axis)] : std::string();
    return role_name(mapped.role) + of + " (" + lines_->name(mapped.line) + ")";
}

std::string SwitchInputs::trouble() const {
    for (const Chip& chip : watched_) {
        if (const std::string what = chip.watch->trouble(); !what.empty()) {
            return "the inputs of " + map_->chips[map_->inputs[chip.input.front()].line.chip].chip +
                   " are not heard any more: " + what;
        }
    }
    return {};
}

std::uint64_t SwitchInputs::missed() const {
    std::uint64_t sum = 0;
    for (const Chip& chip : watched_) {
        sum += chip.watch->missed();
    }
    return sum;
}

} // namespace splinefeed::hal::gpio
