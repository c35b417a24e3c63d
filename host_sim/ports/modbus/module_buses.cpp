// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/module_buses.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

ModuleBuses::ModuleBuses(const ProgramLines& lines, const MakeLine& make, hal::Clock& clock) : lines_(&lines) {
    for (const IoModule& module : lines.modules) {
        const auto found = std::find_if(buses_.begin(), buses_.end(),
                                        [&](const auto& bus) { return bus.first.same_wire(module.address.link); });
        bus_of_module_.push_back(static_cast<std::size_t>(found - buses_.begin()));
        if (found != buses_.end()) {
            continue;
        }
        ModuleBusSettings settings;
        for (const IoModule& other : lines.modules) {
            settings.answer_ms = other.address.link.same_wire(module.address.link)
                                     ? std::max(settings.answer_ms, other.answer_ms)
                                     : settings.answer_ms;
        }
        buses_.emplace_back(module.address.link,
                            std::make_unique<ModuleBus>(module.address.link, settings, make, clock));
    }
    if (lines.mist) {
        add(*lines.mist, false, "mist");
    }
    if (lines.flood) {
        add(*lines.flood, false, "flood");
    }
    for (const DigitalOutput& output : lines.outputs) {
        add(output.line, output.safe_on, fmt::format("output {}", output.number));
    }
    for (const DigitalInput& input : lines.inputs) {
        if (const auto* const sensed = std::get_if<SensedBit>(&input.line)) {
            ModuleBus& bus = bus_of(sensed->module);
            const std::size_t index = bus.add_input(
                bit(sensed->module, sensed->table, sensed->address, fmt::format("input {}", input.number)));
            inputs_[input.number] = {&bus, index, sensed->active_level};
        }
    }
}

ModuleBus& ModuleBuses::bus_of(std::size_t module) {
    return *buses_[bus_of_module_[module]].second;
}

ModuleBit ModuleBuses::bit(std::size_t module, BitTable table, int address, const std::string& what) const {
    const IoModule& of = lines_->modules[module];
    return {of.address.link.unit, table, address,
            fmt::format("{} ({} {} of module {}, {})", what, table == BitTable::coils ? "coil" : "discrete input",
                        address, of.name, of.address.text)};
}

void ModuleBuses::add(const ProgramSwitch& line, bool safe_on, const std::string& what) {
    if (const auto* const coil = std::get_if<SwitchedCoil>(&line)) {
        ModuleBus& bus = bus_of(coil->module);
        const std::size_t index =
            bus.add_coil(bit(coil->module, BitTable::coils, coil->address, what), safe_on == coil->on_level);
        coils_[&line] = {&bus, index, coil->on_level};
    }
}

std::string ModuleBuses::open() {
    for (const auto& [wire, bus] : buses_) {
        if (std::string what = bus->open(); !what.empty()) {
            return what;
        }
    }
    return {};
}

void ModuleBuses::set(const ProgramSwitch& line, bool on) {
    if (const auto found = coils_.find(&line); found != coils_.end()) {
        found->second.bus->set(found->second.index, on == found->second.on_level);
    }
}

void ModuleBuses::end() {
    for (const auto& [wire, bus] : buses_) {
        bus->end();
    }
}

bool ModuleBuses::watch(std::int32_t number) {
    const auto found = inputs_.find(number);
    watched_ = found != inputs_.end() ? &found->second : nullptr;
    if (watched_ != nullptr) {
        watched_->bus->watch(watched_->index);
    }
    return watched_ != nullptr;
}

void ModuleBuses::unwatch() {
    if (watched_ != nullptr) {
        watched_->bus->unwatch();
        watched_ = nullptr;
    }
}

std::optional<InputReading> ModuleBuses::take() {
    const auto reading = watched_ != nullptr ? watched_->bus->take() : std::nullopt;
    return reading ? std::optional(InputReading{reading->on == watched_->on_level, reading->asked_us}) : std::nullopt;
}

std::string ModuleBuses::trouble() const {
    std::string what;
    for (const auto& [wire, bus] : buses_) {
        what = what.empty() ? bus->trouble() : what;
    }
    return what;
}

std::string ModuleBuses::unconfirmed() const {
    std::string what;
    for (const auto& [wire, bus] : buses_) {
        what = what.empty() ? bus->unconfirmed() : what;
    }
    return what;
}

} // namespace splinefeed::host
