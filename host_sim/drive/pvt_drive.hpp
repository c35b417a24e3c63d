// SPDX-License-Identifier: MIT
// PvtDrive: a drive with the register map splinefeed-pvt (docs/reference/pvt_map.md), written from that document.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/pvt_machine.hpp"

#include "splinefeed/hal/modbus/pvt_drive/pvt_registers.hpp"

namespace splinefeed::host {

struct PvtDriveParameters {
    std::vector<PvtAxisParameters> axes = std::vector<PvtAxisParameters>(1); ///< 1 to max_axes
    std::uint16_t ring = 512;                                                ///< at least 16
    std::uint32_t boot = 1;           ///< boot number; increases by one with every power cycle
    std::uint64_t clock_start_us = 0; ///< what its clock shows at first, and after a power cycle
};

/// A machine that says and does what its faults want.
class FaultyPvtMachine : public PvtMachine {
public:
    using PvtMachine::PvtMachine;

    void set_faults(const ModelFaults& faults);
    [[nodiscard]] hal::modbus::PvtRefusal execute(hal::modbus::PvtCommand command, std::uint32_t argument);
    /// What it says of itself.
    [[nodiscard]] hal::modbus::PvtStatus status();

private:
    ModelFaults faults_;
    hal::modbus::PvtStatus stuck_; // what it told when the faults began
    CountNoise noise_;
};

class PvtDrive final : public DriveModel {
public:
    explicit PvtDrive(PvtDriveParameters parameters);

    void advance(std::uint64_t now_us) override { machine_.advance(now_us); }
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) override;
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values) override;
    void power_cycle() override;
    void swap_words() override { swapped_ = !swapped_; }
    void set_faults(const ModelFaults& faults) override { machine_.set_faults(faults); }
    void second_master() override;

    [[nodiscard]] int axes() const override { return machine_.axes(); }
    [[nodiscard]] double position_counts(int axis) const override { return machine_.shaft(axis).position_counts(); }

    [[nodiscard]] PvtMachine& machine() noexcept { return machine_; }
    [[nodiscard]] hal::modbus::PvtStatus status() const { return registers_.completed(machine_.PvtMachine::status()); }

private:
    PvtDriveParameters parameters_;
    FaultyPvtMachine machine_;
    hal::modbus::PvtRegisters<FaultyPvtMachine, max_axes> registers_;
    bool swapped_ = false; // a fault: the least significant word comes first
};

} // namespace splinefeed::host
