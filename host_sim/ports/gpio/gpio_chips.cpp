// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_chips.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>

namespace splinefeed::host {

using hal::gpio::ChipOutputs;
using hal::gpio::LevelMasks;
using hal::gpio::PinBit;

namespace {

LevelMasks masks_of(PinBit line, bool inverted) {
    return {line.mask(), inverted ? line.mask() : 0};
}

void join(LevelMasks& masks, const LevelMasks& others) {
    masks.mask |= others.mask;
    masks.inverted |= others.inverted;
}

} // namespace

GpioChips::GpioChips(const hal::gpio::PinMap& map, const MachineDescription& machine) : map_(&map), machine_(&machine) {
    for (const hal::gpio::ChipPins& chip : map.chips) {
        claims_.emplace_back(chip);
    }
    for (const hal::gpio::ChipPins& chip : map.chips) {
        writer_.push_back(chip.outputs.empty()
                              ? nullptr
                              : std::make_unique<hal::gpio::OutputPins>(chip.chip, map.consumer, chip.outputs));
        source_.push_back(chip.inputs.empty()
                              ? nullptr
                              : std::make_unique<hal::gpio::InputPins>(chip.chip, map.consumer, chip.inputs));
    }
    std::vector<hal::gpio::OutputPins*> lines;
    for (const auto& writer : writer_) {
        if (writer) {
            lines.push_back(writer.get());
        }
    }
    guard_.emplace(lines);
}

std::vector<ChipOutputs> GpioChips::outputs() {
    std::vector<ChipOutputs> chips(map_->chips.size());
    for (std::size_t c = 0; c < chips.size(); ++c) {
        chips[c].writer = writer_[c].get();
    }
    for (const unsigned k : indices(machine_->settings.axes)) {
        const StepMotors& polarity = machine_->motors[k];
        for (unsigned m = 0; m < map_->axis[k].motors; ++m) {
            const hal::gpio::MotorPins& motor = map_->axis[k].motor[m];
            join(chips[motor.step.chip].step[k], masks_of(motor.step, polarity.invert_step));
            join(chips[motor.direction.chip].direction[k], masks_of(motor.direction, polarity.invert_direction[m]));
        }
    }
    if (map_->enable) {
        chips[map_->enable->line.chip].enable = masks_of(map_->enable->line, !map_->enable->active_level);
    }
    if (map_->brake) {
        chips[map_->brake->line.chip].brake = masks_of(map_->brake->line, !map_->brake->released_level);
    }
    std::erase_if(chips, [](const ChipOutputs& chip) { return chip.writer == nullptr; });
    return chips;
}

std::vector<hal::gpio::MachinePins::Inputs> GpioChips::inputs() {
    std::vector<Inputs> all;
    for (std::size_t c = 0; c < source_.size(); ++c) {
        Inputs chip{source_[c].get(), {}};
        for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
            if (map_->inputs[i].line.chip == c) {
                chip.input.push_back(i);
            }
        }
        if (!chip.input.empty()) {
            all.push_back(std::move(chip));
        }
    }
    return all;
}

std::vector<std::uint64_t> GpioChips::set_times_ns(int calls) {
    std::vector<std::uint64_t> slowest;
    std::uint64_t slowest_sum = 0;
    for (std::size_t c = 0; c < writer_.size(); ++c) {
        if (!writer_[c]) {
            continue;
        }
        const auto& outputs = map_->chips[c].outputs;
        const std::uint64_t levels = hal::gpio::safe_levels_of(outputs);
        const std::uint64_t mask = ~std::uint64_t{0} >> (hal::gpio::most_lines - outputs.size());
        std::vector<std::uint64_t> times;
        std::uint64_t sum = 0;
        for (int i = 0; i < calls; ++i) {
            const std::uint64_t before = hal::system_clock().now_ns();
            static_cast<void>(writer_[c]->set(mask, levels));
            times.push_back(hal::system_clock().now_ns() - before);
            sum += times.back();
        }
        if (sum > slowest_sum) {
            slowest_sum = sum;
            slowest = std::move(times);
        }
    }
    return slowest;
}

void GpioChips::make_safe() noexcept {
    for (const auto& writer : writer_) {
        if (writer) {
            writer->make_safe();
        }
    }
}

void GpioChips::keep_drives_on() noexcept {
    if (map_->enable) {
        writer_[map_->enable->line.chip]->retain_levels(map_->enable->line.mask());
    }
    if (map_->brake) {
        writer_[map_->brake->line.chip]->retain_levels(map_->brake->line.mask());
    }
}

std::string GpioChips::name(PinBit input) const {
    const hal::gpio::ChipPins& chip = map_->chips[input.chip];
    const hal::gpio::PinName& line = chip.inputs[input.bit].line;
    return chip.chip + ' ' + (line.name.empty() ? "line " + std::to_string(*line.offset) : line.name);
}

} // namespace splinefeed::host
