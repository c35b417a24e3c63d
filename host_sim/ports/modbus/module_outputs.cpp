// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/module_outputs.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/ports/modbus/module_buses.hpp"
#include "host_sim/ports/modbus/own_wire.hpp"
#include "host_sim/ports/modbus/wire_claims.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/ports/switch_turns.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

class ModuleSwitches final : public RunSwitches {
public:
    ModuleSwitches(const ProgramLines& lines, std::shared_ptr<ModuleBuses> buses)
        : lines_(&lines), buses_(std::move(buses)) {}

    void act(EventKind kind, std::int32_t number) override {
        for (const SwitchTurn& turn : switch_turns(*lines_, kind, number)) {
            buses_->set(*turn.line, turn.on);
        }
    }
    void end() noexcept override { buses_->end(); }
    [[nodiscard]] std::string trouble() const override { return buses_->trouble(); }
    [[nodiscard]] std::string unconfirmed() const override { return buses_->unconfirmed(); }

private:
    const ProgramLines* lines_;
    std::shared_ptr<ModuleBuses> buses_;
};

class ModuleInputs final : public RunInputs {
public:
    explicit ModuleInputs(std::shared_ptr<ModuleBuses> buses) : buses_(std::move(buses)) {}

    [[nodiscard]] bool watch(std::int32_t number) override { return buses_->watch(number); }
    void unwatch() override { buses_->unwatch(); }
    [[nodiscard]] std::optional<InputReading> take() override { return buses_->take(); }
    [[nodiscard]] std::string trouble() const override { return buses_->trouble(); }

private:
    std::shared_ptr<ModuleBuses> buses_;
};

struct ClaimedBuses {
    explicit ClaimedBuses(const ProgramLines& lines) : buses(lines) {
        for (const IoModule& module : lines.modules) {
            claims.add(module.address);
        }
    }

    WireClaims claims;
    ModuleBuses buses;
};

} // namespace

ModuleOutputs make_module_outputs(const MachineDescription& machine, const std::string& target) {
    if (machine.lines.modules.empty()) {
        return {};
    }
    for (const IoModule& module : machine.lines.modules) {
        require_own_wire(module.address, fmt::format("module {}", in_quotes(module.name)), machine, target);
        if (machine.spindle && machine.spindle->vfd &&
            machine.spindle->vfd->address.link.same_wire(module.address.link)) {
            throw UsageError(fmt::format("{}: module {} shares the line of the spindle; give it a line, or a port, of "
                                         "its own",
                                         module.address.text, in_quotes(module.name)));
        }
    }
    const auto claimed = std::make_shared<ClaimedBuses>(machine.lines);
    const std::shared_ptr<ModuleBuses> buses(claimed, &claimed->buses);
    if (const std::string what = buses->open(); !what.empty()) {
        throw TargetError(what);
    }
    return {std::make_unique<ModuleSwitches>(machine.lines, buses), std::make_unique<ModuleInputs>(buses)};
}

} // namespace splinefeed::host
