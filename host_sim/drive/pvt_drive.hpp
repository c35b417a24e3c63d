// SPDX-License-Identifier: MIT
// PvtDrive: a drive with the register map splinefeed-pvt (docs/reference/pvt_map.md), written from that document.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/pvt_machine.hpp"

namespace splinefeed::host {

struct PvtDriveParameters {
    std::vector<PvtAxisParameters> axes = std::vector<PvtAxisParameters>(1); ///< 1 to max_axes
    std::uint16_t ring = 512;                                                ///< at least 16
    std::uint32_t boot = 1;           ///< boot number; increases by one with every power cycle
    std::uint64_t clock_start_us = 0; ///< what its clock shows at first, and after a power cycle
};

class PvtDrive final : public DriveModel {
public:
    explicit PvtDrive(PvtDriveParameters parameters);

    void advance(std::uint64_t now_us) override { machine_.advance(now_us); }
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) override;
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values) override;
    void power_cycle() override;
    void swap_words() override { swapped_ = !swapped_; }
    void set_faults(const ModelFaults& faults) override;
    void second_master() override;

    [[nodiscard]] int axes() const override { return machine_.axes(); }
    [[nodiscard]] double position_counts(int axis) const override { return machine_.shaft(axis).position_counts(); }

    [[nodiscard]] PvtMachine& machine() noexcept { return machine_; }
    [[nodiscard]] hal::modbus::PvtStatus status() const;
    /// What it says of itself: with its faults.
    [[nodiscard]] hal::modbus::PvtStatus told_status();

private:
    [[nodiscard]] hal::modbus::PvtIdentity identity() const;
    [[nodiscard]] ModbusException write_configuration(std::size_t at, std::span<const std::uint16_t> values);
    [[nodiscard]] ModbusException write_block(std::span<const std::uint16_t> registers);
    [[nodiscard]] hal::modbus::PvtRefusal take(const hal::modbus::PvtBlock& block,
                                               std::span<const hal::modbus::PvtSegment> segments);
    [[nodiscard]] hal::modbus::PvtRefusal command(const hal::modbus::PvtBlock& block,
                                                  std::span<const hal::modbus::PvtSegment> segments);

    PvtDriveParameters parameters_;
    PvtMachine machine_;
    std::uint32_t boot_;
    std::uint16_t nonce_ = 0;
    std::uint16_t last_command_ = 0;
    std::uint16_t refusals_ = 0;
    hal::modbus::PvtRefusal refused_ = hal::modbus::PvtRefusal::none;
    bool swapped_ = false; // a fault: the least significant word comes first
    ModelFaults faults_;
    hal::modbus::PvtStatus stuck_; // what it told when the faults began
    CountNoise noise_;
};

} // namespace splinefeed::host
