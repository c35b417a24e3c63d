// SPDX-License-Identifier: MIT
// FaultyDrive: a drive of a profile with ModelFaults: they are where its registers are read and written.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <memory>
#include <vector>

namespace splinefeed::host {

/// Looks at fields by the profile: what is stuck is what the last reading told.
class FaultyDrive final : public DriveModel {
public:
    /// @pre the profile is that of the drive, and does not stream pvt
    FaultyDrive(std::unique_ptr<DriveModel> drive, hal::modbus::DriveProfile profile);

    void advance(std::uint64_t now_us) override { drive_->advance(now_us); }
    [[nodiscard]] ModbusException read(int place, std::span<std::uint16_t> out) override;
    [[nodiscard]] ModbusException write(int place, std::span<const std::uint16_t> values) override;
    void power_cycle() override { drive_->power_cycle(); }
    void swap_words() override;
    void set_faults(const ModelFaults& faults) override { faults_ = faults; }
    void second_master() override;
    [[nodiscard]] int axes() const override { return drive_->axes(); }
    [[nodiscard]] double position_counts(int axis) const override { return drive_->position_counts(axis); }

private:
    [[nodiscard]] bool is_state(hal::modbus::FieldIndex index) const;
    [[nodiscard]] bool stops(int place, std::span<const std::uint16_t> values) const;

    std::unique_ptr<DriveModel> drive_;
    hal::modbus::DriveProfile profile_;
    std::vector<std::int64_t> told_; // raw, by field
    ModelFaults faults_;
    CountNoise noise_;
};

} // namespace splinefeed::host
