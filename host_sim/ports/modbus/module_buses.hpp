// SPDX-License-Identifier: MIT
// ModuleBuses: the coils and inputs of all I/O modules of a machine, each by what the machine file says of it.
#pragma once

#include "host_sim/config/program_lines.hpp"
#include "host_sim/ports/run_inputs.hpp"

#include "splinefeed/hal/modbus/module/module_bus.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace splinefeed::host {

/// A ModuleBus for each wire.
class ModuleBuses {
public:
    /// @param lines  must outlive it
    explicit ModuleBuses(const ProgramLines& lines, const hal::modbus::MakeLine& make = hal::modbus::make_link,
                         hal::Clock& clock = hal::system_clock());

    /// ModuleBus::open() of all: everything is as it is safe then. Returns an empty text, or what cannot be used and
    /// why.
    [[nodiscard]] std::string open();
    /// Lines that are not of a module are left to others.
    void set(const ProgramSwitch& line, bool on);
    void end();
    /// From now on this input is read; false: it is none of a module.
    [[nodiscard]] bool watch(std::int32_t number);
    void unwatch();
    [[nodiscard]] std::optional<InputReading> take();
    /// The first that has any; empty: none has.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] std::string unconfirmed() const;

private:
    struct Place {
        hal::modbus::ModuleBus* bus = nullptr;
        std::size_t index = 0;
        bool on_level = true;
    };

    [[nodiscard]] hal::modbus::ModuleBus& bus_of(std::size_t module);
    [[nodiscard]] hal::modbus::ModuleBit bit(std::size_t module, hal::modbus::BitTable table, int address,
                                             const std::string& what) const;
    void add(const ProgramSwitch& line, bool safe_on, const std::string& what);

    const ProgramLines* lines_;
    std::vector<std::pair<hal::modbus::LinkAddress, std::unique_ptr<hal::modbus::ModuleBus>>> buses_;
    std::vector<std::size_t> bus_of_module_;
    std::map<const ProgramSwitch*, Place> coils_;
    std::map<std::int32_t, Place> inputs_;
    const Place* watched_ = nullptr;
};

} // namespace splinefeed::host
