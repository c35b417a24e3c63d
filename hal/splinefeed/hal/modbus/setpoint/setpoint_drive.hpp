// SPDX-License-Identifier: MIT
// SetpointDrive: one drive of one axis that gets cyclic targets or blocks by its profile: targets, status, commands.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"
#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/hal/modbus/setpoint/block_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/command_sequence.hpp"
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"
#include "splinefeed/hal/stop_sequence.hpp"

#include <functional>
#include <string>

namespace splinefeed::hal::modbus {

/// Settings of a drive for a motion.
struct SetpointSettings {
    int axis = 0;                        ///< index in the feed segments
    std::uint32_t period_us = 10'000;    ///< between two targets
    double acceleration_counts_s2 = 1e6; ///< planned acceleration of the axis
    double ramp_counts_s2 = 4e6;         ///< BlockSettings::acceleration
    double fastest_counts_s = 0.0;       ///< BlockSettings::fastest, CyclicSettings::fastest
    double standstill_counts = 2.0;      ///< SetpointWiring
};

/// Waits until an instant, between two frames of a command. [us] false: the command is given up.
using CommandPause = std::function<bool(std::uint64_t until_us)>;

/// For one thread at a time. Constructor, open() and configure() allocate; the other functions do not.
class SetpointDrive {
public:
    /// Profile and link must outlive the drive.
    SetpointDrive(const DriveProfile& profile, ModbusWire& link, int unit);

    /// Connects, checks that it is the right drive and that it can be switched off, and reads the status. Returns what
    /// is wrong; empty: nothing.
    [[nodiscard]] std::string open();
    /// Makes the stream. @pre called before everything below; open
    void configure(const SetpointSettings& settings);
    /// Writes the init list; a flash register only if its value differs. Returns false on failure.
    [[nodiscard]] bool write_initial();
    /// Writes a value; true also if the drive has no such register. Returns false on failure.
    [[nodiscard]] bool write_role(FieldRole role, std::int64_t physical_q16);
    /// The motion starts at the present position; a drive with blocks gets it as its first target. Returns false on
    /// failure.
    [[nodiscard]] bool prime();
    /// Repeats a failed exchange as often as the profile says; connects again after the connection was lost.
    template <class Try>
    [[nodiscard]] bool retry(const Try& attempt) {
        for (int i = 0; i <= profile_->link.retries; ++i) {
            if (attempt()) {
                return true;
            }
            if (!link_->connected()) {
                static_cast<void>(link_->connect());
            }
        }
        return false;
    }

    /// Computes the frames of the target for that instant.
    void prepare_frames(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// Writes the frames. Returns false if they were not answered or were refused. The next frames are then written
    /// twice, because the last state of a toggle is unknown.
    bool send() noexcept;
    /// Call when no target was sent for so long that the drive stands.
    void on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// Whether a cyclic drive comes back to the path; false for drives with blocks.
    [[nodiscard]] bool behind() const noexcept { return cyclic_ && cyclic_->behind(); }
    /// Whether a drive with blocks stands, by the model of its blocks; false for cyclic drives.
    [[nodiscard]] bool at_rest() const noexcept { return block_ && block_->at_rest(); }
    /// Call when the drive has stood for some time by the model of its blocks. If it reports another position, because
    /// a block was lost, the next block starts from the reported one.
    void resync_position() noexcept;
    /// Reports between which instants the last frames arrived; the latest is UINT64_MAX: nobody knows whether they did.
    void on_arrival(std::uint64_t earliest_us, std::uint64_t latest_us) noexcept;
    /// Reads the status for reading(): all its frames, or the next one in turn. Return false on failure.
    bool read_status() noexcept;
    bool read_next() noexcept;
    /// Sends all frames of a command. Blocks. Returns false after that many failures and one more, or if the profile
    /// has no such command.
    bool command(DriveCommand command, int failures, const CommandPause& pause = {}) noexcept;
    /// Stops the drive by the first command that its profile has: for a quick stop quick_stop, halt or disable; to
    /// switch it off disable. Does not retry, so that other drives on the wire need not wait. Returns false if there
    /// was no answer or the profile has no such command.
    bool stop(StopRequest request) noexcept;

    [[nodiscard]] const DriveReading& reading() const noexcept { return reading_; }
    [[nodiscard]] bool end_sent(const TrajectoryBuffer& track, std::uint64_t motion_us) const noexcept;
    /// Whether the reported position is at the target of the last block, within the tolerance of a position loop; true
    /// for cyclic drives.
    [[nodiscard]] bool at_target() const noexcept;
    /// Whether the drive reports that it stands at its target, after its last block: false for cyclic drives, which
    /// have no word for it.
    [[nodiscard]] bool says_it_stands() const noexcept {
        return block_ && reading_.done && reading_.state == DriveState::enabled && at_target();
    }
    /// Whether a value exceeded the range of its register.
    [[nodiscard]] bool clamped() const noexcept;
    /// `segments` counts the targets.
    [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }
    [[nodiscard]] const LinkAnswer& last_answer() const noexcept { return answer_; }
    [[nodiscard]] std::uint64_t answered_us() const noexcept { return answered_us_; }
    /// Earliest instant of the oldest part of reading(); 0: not all parts were read yet.
    [[nodiscard]] std::uint64_t status_us() const noexcept;
    /// Earliest instant of the position in reading(); 0: it was not read yet.
    [[nodiscard]] std::uint64_t position_us() const noexcept { return status_us_[status_.position_read()]; }
    [[nodiscard]] const DriveProfile& profile() const noexcept { return *profile_; }
    [[nodiscard]] int unit() const noexcept { return unit_; }
    [[nodiscard]] ModbusWire& link() noexcept { return *link_; }
    /// "what: why the last exchange failed"
    [[nodiscard]] std::string trouble(const char* what) const;

private:
    [[nodiscard]] SetpointFrames& frames() noexcept { return block_ ? block_->frames() : cyclic_->frames(); }
    bool write(const RegisterWrite& write) noexcept;
    bool read(std::uint16_t address, std::span<std::uint16_t> out) noexcept;
    bool record(const LinkAnswer& answer) noexcept;
    [[nodiscard]] bool write_field(FieldIndex field, std::int64_t raw);
    [[nodiscard]] std::string check_setup(const std::vector<DriveProfile::SetupCheck>& checks, bool must_hold,
                                          const char* unread);

    const DriveProfile* profile_;
    ModbusWire* link_;
    int unit_;
    StatusFrames status_;
    std::optional<BlockStream> block_;
    std::optional<CyclicStream> cyclic_;
    std::span<const RegisterWrite> prepared_;
    bool delivery_unknown_ = false; // the last frames may be lost
    DriveReading reading_;
    LinkAnswer answer_;
    LinkCounts counts_;
    double standstill_counts_ = 0.0; // SetpointSettings
    std::uint64_t answered_us_ = 0;
    std::size_t next_read_ = 0;                                       // counter of status frames
    std::array<std::uint64_t, StatusFrames::most_reads> status_us_{}; // of each status frame
};

} // namespace splinefeed::hal::modbus
