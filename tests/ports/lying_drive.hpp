// SPDX-License-Identifier: MIT
// LyingDrive: a simulated drive with the map splinefeed-pvt whose firmware is wrong: it reports what is not so, or does
// not do what it is told.
#pragma once

#include "host_sim/drive/pvt_drive.hpp"

#include <functional>
#include <optional>

namespace splinefeed_test {

class LyingDrive final : public splinefeed::host::DriveModel {
public:
    using Block = splinefeed::hal::modbus::PvtBlock;
    using Exception = splinefeed::host::ModbusException;
    using Status = splinefeed::hal::modbus::PvtStatus;

    explicit LyingDrive(const splinefeed::host::PvtDriveParameters& parameters) : drive(parameters) {}

    splinefeed::host::PvtDrive drive;
    std::function<void(Status&)> lie;                                ///< changes what it reports
    std::optional<splinefeed::hal::modbus::PvtCommand> ignores;      ///< this command has no effect, and no refusal
    std::optional<splinefeed::hal::modbus::PvtCommand> last_command; ///< that it got

    void advance(std::uint64_t now_us) override { drive.advance(now_us); }
    [[nodiscard]] Exception read(int address, std::span<std::uint16_t> out) override {
        namespace pvt = splinefeed::hal::modbus::pvt;
        const Exception exception = drive.read(address, out);
        const bool status = address == pvt::status_address && out.size() == pvt::status_registers(drive.axes());
        if (exception != Exception::none || !status) {
            return exception;
        }
        Status reported = splinefeed::hal::modbus::decode_status(out, drive.axes());
        reported.nonce = swallowed_.value_or(reported.nonce);
        if (lie) {
            lie(reported);
        }
        encode(reported, drive.axes(), out);
        return Exception::none;
    }
    [[nodiscard]] Exception write(int address, std::span<const std::uint16_t> values) override {
        splinefeed::hal::modbus::PvtSegments segments{};
        const auto block = address == splinefeed::hal::modbus::pvt::block_address
                               ? splinefeed::hal::modbus::decode_block(values, drive.axes(), segments)
                               : std::nullopt;
        swallowed_.reset();
        if (block && block->command != splinefeed::hal::modbus::PvtCommand::none) {
            last_command = block->command;
        }
        if (block && ignores && block->command == *ignores) {
            swallowed_ = block->nonce;
            return Exception::none;
        }
        return drive.write(address, values);
    }
    void power_cycle() override { drive.power_cycle(); }
    void swap_words() override { drive.swap_words(); }
    [[nodiscard]] int axes() const override { return drive.axes(); }
    [[nodiscard]] double position_counts(int axis) const override { return drive.position_counts(axis); }

private:
    std::optional<std::uint16_t> swallowed_; // nonce of a block that it ignored
};

} // namespace splinefeed_test
