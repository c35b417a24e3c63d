// SPDX-License-Identifier: MIT
// ModbusTarget: the common part of runs on Modbus drives, both those that interpolate and those that follow target
// positions.
#pragma once

#include "host_sim/config/drive_table.hpp"
#include "host_sim/output/place_text.hpp"
#include "host_sim/ports/modbus/drive_sentence.hpp"
#include "host_sim/ports/modbus/wire_claims.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/ports/stop_sentence.hpp"

#include <utility>
#include <vector>

namespace splinefeed::host {

/// What drives are reached by, and its time.
struct DriveWires {
    hal::modbus::MakeWire make = hal::modbus::make_link;
    hal::Clock* clock = &hal::system_clock(); ///< must outlive the target
};

/// A port with the drives of a table, in the same order.
template <class Port>
class ModbusTarget : public RunTarget {
protected:
    /// Connects to the drives. Throws TargetError.
    /// @param wiring_of  converts the drives of a table to the form of the port
    template <class WiringOf>
    ModbusTarget(DriveTable table, const MachineDescription& machine, const RunOptions& options,
                 const DriveWires& wires, WiringOf wiring_of)
        : machine_(&machine), table_(std::move(table)), claims_(table_),
          port_(wiring_of(table_, machine), {.orders = options.orders,
                                             .interrupted = options.interrupted,
                                             .make_wire = wires.make,
                                             .clock = wires.clock}) {
        require(port_.open());
    }

    /// Throws TargetError if there is a failure.
    void require(const hal::PortFailure& failure) const {
        if (failure) {
            throw TargetError(drive_sentence(table_, failure));
        }
    }

    [[nodiscard]] std::vector<StoppedDrive> stopped() const {
        std::vector<StoppedDrive> drives;
        for (std::size_t i = 0; i < port_.drives(); ++i) {
            drives.push_back({table_.drives[i].name, port_.stop_report(i)});
        }
        return drives;
    }

    /// Of an axis that stands at this position in the machine's own direction, once it has its reference. A drive that
    /// answers and did not confirm its stop may still move.
    [[nodiscard]] AxisPlace place(std::size_t drive, unsigned axis, double counts, bool online) const {
        const double mm = counts / machine_->settings.axis[axis].steps_per_mm;
        const bool moves = online && port_.stop_report(drive).state == hal::StopState::unconfirmed;
        return {axis, port_.referenced() && !moves ? std::optional(mm) : std::nullopt, online};
    }
    /// The same before prepare(): where it will stand behind it.
    /// @param placed  the counts are those of the machine
    [[nodiscard]] AxisPlace standing_place(unsigned axis, double counts, bool placed) const {
        const bool homes = port_.orders().home; // then it stands at 0
        const double mm = homes ? 0.0 : counts / machine_->settings.axis[axis].steps_per_mm;
        return {axis, homes || placed ? std::optional(mm) : std::nullopt};
    }
    /// Of all drives on Modbus, each axis with a home of its own.
    [[nodiscard]] TargetFacts drive_facts() const {
        TargetFacts out{.halts = true};
        for (const unsigned k : indices(machine_->settings.axes)) {
            out.homes_with[k] = 1U << k;
        }
        return out;
    }
    /// Without homing nothing moves before the port is ready.
    [[nodiscard]] bool may_have_moved() const noexcept { return port_.orders().home || port_.referenced(); }

    const MachineDescription* machine_;
    DriveTable table_;
    WireClaims claims_;
    Port port_;

private:
    [[nodiscard]] std::string where() const final {
        const std::vector<AxisPlace> all = places();
        PlaceText text;
        for (const AxisPlace& at : all) {
            text.add(machine_->axis_name[at.axis], at.mm, at.online);
        }
        return all.empty() ? "; nothing was moved" : text.text();
    }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    [[nodiscard]] std::string sentence(const hal::PortFailure& failure) const override {
        return drive_sentence(table_, failure) + unconfirmed_drives(stopped());
    }
    [[nodiscard]] std::string halted(bool quick) const override { return stop_sentence(stopped(), quick); }
    [[nodiscard]] std::string leave(bool off) override {
        if (off || !machine_->drives_on_at_end.value_or(true)) {
            port_.power_off();
            return not_switched_off(stopped());
        }
        const std::string moving = unconfirmed_drives(stopped());
        return moving.empty() ? moving : moving.substr(2);
    }
};

} // namespace splinefeed::host
