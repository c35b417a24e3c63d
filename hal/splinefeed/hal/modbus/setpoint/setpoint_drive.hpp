// SPDX-License-Identifier: MIT
// SetpointDrive: a drive that gets target positions or blocks by its profile, one axis: enabling, targets, status.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"
#include "splinefeed/hal/modbus/link/modbus_line.hpp"
#include "splinefeed/hal/modbus/setpoint/block_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/command_sequence.hpp"
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"
#include "splinefeed/hal/stop_sequence.hpp"

#include <functional>
#include <string>

namespace splinefeed::hal::modbus {

/// How targets are to be sent.
struct SetpointSettings {
    int axis = 0;                        ///< of the feed segments
    std::uint32_t period_us = 10'000;    ///< between two targets
    double acceleration_counts_s2 = 1e6; ///< of the axis, as planned
    bool home = false;                   ///< it finds its reference first
    bool (*interrupted)() = nullptr;     ///< asked meanwhile: a quick stop
    double ramp_counts_s2 = 4e6;         ///< BlockSettings::acceleration
    double fastest_counts_s = 0.0;       ///< BlockSettings::fastest
    /// Asked again and again while this drive is waited for: other drives are heard meanwhile, so that their watchdogs
    /// do not run out. What it returns, if not empty, ends the wait.
    std::function<std::string()> meanwhile{};
};

/// Used by one thread at a time. It allocates when it is made and in open(), and never again.
class SetpointDrive {
public:
    /// All must outlive it.
    SetpointDrive(const DriveProfile& profile, ModbusLine& link, int unit);

    /// Connects, checks the identity, writes the init list, reads the status. Empty, or what is wrong.
    [[nodiscard]] std::string open();
    /// Mode, windows, fault reset, enable: blocks for some seconds. Empty, or what is wrong.
    [[nodiscard]] std::string enable(const SetpointSettings& settings);
    /// Then: it finds its reference, if so set, and is told to stand where it is. Blocks until it does.
    [[nodiscard]] std::string begin(const SetpointSettings& settings);

    /// Computes the frames that arrive at that instant.
    void prepare_frames(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// Writes them. False: they were not answered, or refused. Then the next ones are written twice: where a toggle
    /// starts a block, nobody knows how the drive saw it last.
    bool send() noexcept;
    /// It was not told anything for longer than it goes on by itself: it stands.
    void on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// A drive that is told blocks stands, as far as they tell.
    [[nodiscard]] bool at_rest() const noexcept { return block_ && block_->at_rest(); }
    /// It has on_setpoint_timeout for some time, as far as its blocks tell. Where it says that it is elsewhere, since
    /// it is not known which of them it got, the next one goes on from there.
    void resync_position() noexcept;
    /// When the last block arrived; UINT64_MAX: it did not.
    void on_arrival(std::uint64_t arrival_us) noexcept;
    /// Reads what reading() tells: all frames of it, or the next one in turn.
    bool read_status() noexcept;
    bool read_next() noexcept;
    /// Sends a command from its first to its last frame, ahead of everything.
    bool command(DriveCommand command) noexcept;
    /// Stops it by what its profile has, the first of: for a quick stop quick_stop, halt, disable; to switch it off
    /// disable. Does not try again, so that other drives of the wire need not wait. False: it was not answered, or the
    /// profile has no such command.
    bool stop(StopRequest request) noexcept;

    [[nodiscard]] const DriveReading& reading() const noexcept { return reading_; }
    [[nodiscard]] bool end_sent(const TrajectoryBuffer& track, std::uint64_t motion_us) const noexcept;
    /// It stands within what a loop in position may be off where the last block sent it; a cyclic drive: true.
    [[nodiscard]] bool at_target() const noexcept;
    /// A register could not hold what it was to be told.
    [[nodiscard]] bool clamped() const noexcept;
    /// Its segments are the targets.
    [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }
    [[nodiscard]] const LinkAnswer& last_answer() const noexcept { return answer_; }
    [[nodiscard]] std::uint64_t answered_us() const noexcept { return answered_us_; }
    /// When reading() was said, the oldest part of it; 0: not all of it was read yet.
    [[nodiscard]] std::uint64_t status_us() const noexcept;
    [[nodiscard]] const DriveProfile& profile() const noexcept { return *profile_; }
    [[nodiscard]] int unit() const noexcept { return unit_; }
    [[nodiscard]] ModbusLine& link() noexcept { return *link_; }

private:
    [[nodiscard]] SetpointFrames& frames() noexcept { return block_ ? block_->frames() : cyclic_->frames(); }
    bool command(DriveCommand command, int failures) noexcept;
    template <class Work>
    [[nodiscard]] std::string run_with_meanwhile(const SetpointSettings& settings, const Work& work);
    [[nodiscard]] std::string switch_on(const SetpointSettings& settings);
    [[nodiscard]] bool wait_until(std::uint64_t instant_us) noexcept;
    bool write(const RegisterWrite& write) noexcept;
    bool read(std::uint16_t address, std::span<std::uint16_t> out) noexcept;
    bool record(const LinkAnswer& answer) noexcept;
    template <class Try>
    [[nodiscard]] bool retry(const Try& attempt);
    [[nodiscard]] bool set_field(FieldIndex field, std::int64_t raw);
    [[nodiscard]] bool set_role(FieldRole role, std::int64_t physical_q16);
    [[nodiscard]] bool initialise();
    [[nodiscard]] std::string home(const SetpointSettings& settings);
    [[nodiscard]] std::string prime_blocks();
    [[nodiscard]] std::string not_enabled() const;
    [[nodiscard]] std::string check_identity();
    [[nodiscard]] std::string trouble(const char* what) const;

    const DriveProfile* profile_;
    ModbusLine* link_;
    int unit_;
    StatusFrames status_;
    std::optional<BlockStream> block_;
    std::optional<CyclicStream> cyclic_;
    std::span<const RegisterWrite> prepared_;
    bool delivery_unknown_ = false; // whether it got the last ones
    DriveReading reading_;
    LinkAnswer answer_;
    LinkCounts counts_;
    std::function<std::string()> meanwhile_; // SetpointSettings
    std::string trouble_elsewhere_;          // that it told
    std::uint64_t answered_us_ = 0;
    std::size_t next_read_ = 0;                                       // frames of the status so far
    std::array<std::uint64_t, StatusFrames::most_reads> status_us_{}; // each of them
};

} // namespace splinefeed::hal::modbus
