// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/modbus_outputs.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/ports/modbus/wire_claims.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/ports/switch_turns.hpp"
#include "splinefeed/hal/modbus/module/module_bus.hpp"
#include "splinefeed/hal/modbus/spindle/vfd_spindle.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

/// Spindles and modules are not on the wire of a drive, whose thread would have to wait for them. Throws UsageError if
/// a drive of the run is on the device's wire. @param what  the device, for the message: "the spindle"
void require_own_wire(const DriveAddress& device, const std::string& what, const MachineDescription& machine,
                      const std::string& target) {
    const bool all = target == "modbus";
    if (!all && target.rfind("modbus-", 0) != 0) {
        return;
    }
    for (const unsigned k : indices(machine.settings.axes)) {
        const DriveAddress drive = parse_drive_address(all ? machine.drive[k] : target);
        if (drive.link.same_wire(device.link)) {
            throw UsageError("{}: {} shares the line of the drive of axis {}; give it a line, or a port, "
                             "of its own",
                             device.text, what, machine.axis_name[k]);
        }
    }
}

class VfdRunSpindle final : public OutputPart {
public:
    explicit VfdRunSpindle(const SpindleDescription& spindle)
        : spindle_(&spindle), claims_(spindle.vfd->address),
          vfd_({spindle.vfd->address.link, spindle.vfd->profile},
               {.at_speed_timeout_ms = static_cast<std::uint32_t>(std::lround(spindle.at_speed_timeout_s * 1e3))}) {
        if (const std::string what = vfd_.open(); !what.empty()) {
            throw TargetError("{}: {}", spindle.vfd->address.text, what);
        }
    }

    void act(const ProgramAction& action) override {
        if (action.spindle) {
            vfd_.order({action.spindle->direction, action.spindle->rpm / spindle_->rpm_per_hz});
        }
    }
    void end() noexcept override { vfd_.end(); }
    [[nodiscard]] Progress progress() const override {
        return {vfd_.reached(), !vfd_.was_on() || vfd_.stands(), spindle_->at_speed_timeout_s};
    }
    [[nodiscard]] std::string trouble() const override {
        const std::string what = vfd_.trouble();
        return what.empty() ? what : fmt::format("{}: {}", spindle_->vfd->address.text, what);
    }

private:
    const SpindleDescription* spindle_;
    WireClaims claims_;
    VfdSpindle vfd_;
};

/// The coils and inputs of all I/O modules of a machine, each by what the machine file says of it: a ModuleBus for each
/// wire.
class IoModuleOutputs final : public OutputPart {
public:
    /// @param lines  must outlive it
    explicit IoModuleOutputs(const ProgramPins& lines) : lines_(&lines) {
        for (const IoModule& module : lines.modules) {
            claims_.add(module.address);
        }
        for (const IoModule& module : lines.modules) {
            const auto found =
                std::ranges::find_if(buses_, [&](const auto& bus) { return bus.first.same_wire(module.address.link); });
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
            buses_.emplace_back(module.address.link, std::make_unique<ModuleBus>(module.address.link, settings));
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

    /// ModuleBus::open() of all: everything is as it is safe then. Returns an empty text, or what cannot be used and
    /// why.
    [[nodiscard]] std::string open() {
        for (const auto& [wire, bus] : buses_) {
            if (std::string what = bus->open(); !what.empty()) {
                return what;
            }
        }
        return {};
    }

    // Lines that are not of a module are left to others.
    void act(const ProgramAction& action) override {
        for (const SwitchTurn& turn : switch_turns(*lines_, action.kind, action.number)) {
            if (const auto found = coils_.find(turn.line); found != coils_.end()) {
                found->second.bus->set(found->second.index, turn.on == found->second.on_level);
            }
        }
        if (action.kind == EventKind::input_wait) {
            watch(action.number);
        }
    }

    void end() noexcept override {
        for (const auto& [wire, bus] : buses_) {
            bus->end();
        }
    }

    [[nodiscard]] std::optional<InputReading> take() override {
        const auto reading = watched_ != nullptr ? watched_->bus->take() : std::nullopt;
        return reading ? std::optional(InputReading{reading->on == watched_->on_level, reading->asked_us})
                       : std::nullopt;
    }

    [[nodiscard]] std::string trouble() const override {
        std::string what;
        for (const auto& [wire, bus] : buses_) {
            what = what.empty() ? bus->trouble() : what;
        }
        return what;
    }

    [[nodiscard]] std::string unconfirmed() const override {
        std::string what;
        for (const auto& [wire, bus] : buses_) {
            what = what.empty() ? bus->unconfirmed() : what;
        }
        return what;
    }

private:
    struct Place {
        ModuleBus* bus = nullptr;
        std::size_t index = 0;
        bool on_level = true;
    };

    void watch(std::int32_t number) {
        if (watched_ != nullptr) {
            watched_->bus->unwatch();
        }
        const auto found = inputs_.find(number);
        watched_ = found != inputs_.end() ? &found->second : nullptr;
        if (watched_ != nullptr) {
            watched_->bus->watch(watched_->index);
        }
    }

    [[nodiscard]] ModuleBus& bus_of(std::size_t module) { return *buses_[bus_of_module_[module]].second; }

    [[nodiscard]] ModuleBit bit(std::size_t module, BitTable table, int address, const std::string& what) const {
        const IoModule& of = lines_->modules[module];
        return {of.address.link.unit, table, address,
                fmt::format("{} ({} {} of module {}, {})", what, table == BitTable::coils ? "coil" : "discrete input",
                            address, of.name, of.address.text)};
    }

    void add(const ProgramSwitch& line, bool safe_on, const std::string& what) {
        if (const auto* const coil = std::get_if<SwitchedCoil>(&line)) {
            ModuleBus& bus = bus_of(coil->module);
            const std::size_t index =
                bus.add_coil(bit(coil->module, BitTable::coils, coil->address, what), safe_on == coil->on_level);
            coils_[&line] = {&bus, index, coil->on_level};
        }
    }

    const ProgramPins* lines_;
    WireClaims claims_;
    std::vector<std::pair<LinkAddress, std::unique_ptr<ModuleBus>>> buses_;
    std::vector<std::size_t> bus_of_module_;
    std::map<const ProgramSwitch*, Place> coils_;
    std::map<std::int32_t, Place> inputs_;
    const Place* watched_ = nullptr;
};

std::shared_ptr<IoModuleOutputs> make_module_outputs(const MachineDescription& machine, const std::string& target) {
    for (const IoModule& module : machine.lines.modules) {
        require_own_wire(module.address, fmt::format("module {}", in_quotes(module.name)), machine, target);
        if (machine.spindle && machine.spindle->vfd &&
            machine.spindle->vfd->address.link.same_wire(module.address.link)) {
            throw UsageError("{}: module {} shares the line of the spindle; give it a line, or a port, of its own",
                             module.address.text, in_quotes(module.name));
        }
    }
    auto modules = std::make_shared<IoModuleOutputs>(machine.lines);
    if (const std::string what = modules->open(); !what.empty()) {
        throw TargetError(what);
    }
    return modules;
}

} // namespace

OutputParts make_modbus_outputs(const MachineDescription& machine, const std::string& target) {
    OutputParts out;
    if (machine.spindle && machine.spindle->vfd) {
        require_own_wire(machine.spindle->vfd->address, "the spindle", machine, target);
        out.push_back(std::make_shared<VfdRunSpindle>(*machine.spindle));
    }
    if (!machine.lines.modules.empty()) {
        out.push_back(make_module_outputs(machine, target));
    }
    return out;
}

} // namespace splinefeed::host
