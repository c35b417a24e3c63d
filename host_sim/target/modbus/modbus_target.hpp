// SPDX-License-Identifier: MIT
// ModbusTarget: the common part of runs on Modbus drives, both those that interpolate and those that follow target
// positions.
#pragma once

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/config/drive_table.hpp"
#include "host_sim/target/run_target.hpp"
#include "host_sim/target/stop_sentence.hpp"

#include <utility>
#include <vector>

namespace splinefeed::host {

/// A port with the drives of a table, in the same order.
template <class Port>
class ModbusTarget : public RunTarget {
protected:
    /// @param wiring_of  converts the drives of a table to the form of the port
    template <class WiringOf>
    ModbusTarget(DriveTable table, const MachineDescription& machine, bool home, WiringOf wiring_of)
        : machine_(&machine), table_(std::move(table)),
          port_(wiring_of(table_, machine), {.home = home, .interrupted = &SignalWatch::interrupted}) {}

    [[nodiscard]] std::vector<StoppedDrive> stopped() const {
        std::vector<StoppedDrive> drives;
        for (std::size_t i = 0; i < port_.drives(); ++i) {
            drives.push_back({table_.drives[i].address.text, port_.stop_report(i)});
        }
        return drives;
    }

    const MachineDescription* machine_;
    DriveTable table_;
    Port port_;

private:
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    void complete() override { port_.complete(); }
    void quick_stop() override { port_.quick_stop(); }
    [[nodiscard]] std::string halted(bool quick) const override { return stop_sentence(stopped(), quick); }
    [[nodiscard]] std::string finish() override {
        if (machine_->drives_on_at_end.value_or(true)) {
            return {};
        }
        port_.power_off();
        return not_switched_off(stopped());
    }
    void release() noexcept override { port_.close(); }
};

} // namespace splinefeed::host
