// SPDX-License-Identifier: MIT
// BlockStream: one axis of a motion as positioning blocks that replace each other on the fly.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

struct BlockSettings {
    int axis = 0;                    ///< of the feed segments
    std::uint32_t period_us = 10000; ///< between two blocks
    /// How long the drive may go on beyond a period without a new block, at its speed, before it brakes; 0: a period.
    std::uint32_t reserve_us = 0;
    /// Of the drive's ramps [counts/s^2]: written where it has fields for it, else what it is set to. Four times that
    /// of the path or more: a speed is reached within a quarter of a period then, and errors of speed die out by a
    /// third from block to block.
    double acceleration = 1e6;
    /// Of a drive that catches up, unless the path itself is faster [counts/s]; 0: what its ramp reaches in a period.
    double fastest = 0.0;
};

/// Each block has the speed with which the drive is on the path a period later, and its target further ahead, so that
/// it cruises through. What the drive makes of the blocks, with speeds and ramps rounded as its registers have them, is
/// computed along, so nothing adds up.
///
/// How near it stays to the path where blocks come once a period: line_deviation_counts, plus period * half a unit of
/// the speed's register, plus half a unit of the position's. Where a link dies, the drive stops by itself, on a
/// straight line, no further than speed * (period + reserve) and its braking distance.
class BlockStream {
public:
    /// The profile must outlive it. @pre it streams blocks
    BlockStream(const DriveProfile& profile, const BlockSettings& settings);

    /// The drive stands here.
    void begin(double position_counts) noexcept;
    /// The frames of the block whose last one arrives at this instant. @pre the track is not empty, and the instant not
    /// before the last one
    [[nodiscard]] std::span<const RegisterWrite> block(const TrajectoryBuffer& track,
                                                       const MotionInstant& instant) noexcept;
    /// The same while the motion runs at its full rate.
    [[nodiscard]] std::span<const RegisterWrite> block(const TrajectoryBuffer& track,
                                                       std::uint64_t arrival_us) noexcept {
        return block(track, {arrival_us, arrival_us, arrival_us + settings_.period_us});
    }
    /// The frames that set all that will not change, and have it stand where it stands: before the motion, so that its
    /// first block is as short as the others.
    [[nodiscard]] std::span<const RegisterWrite> prime() noexcept;
    /// The last block arrived at that instant instead; UINT64_MAX: it did not, and the one before goes on. Else it
    /// counts as in time.
    void on_arrival(std::uint64_t arrival_us) noexcept;
    /// A register could not hold a target or a speed.
    [[nodiscard]] bool clamped() const noexcept { return clamped_; }
    /// The last block led to the end of the motion.
    [[nodiscard]] bool end_sent() const noexcept { return end_sent_; }
    /// The last frames once more, as a start of their own.
    [[nodiscard]] std::span<const RegisterWrite> repeat() noexcept { return frames_.build(); }
    /// Where the last block sent the drive.
    [[nodiscard]] double target_counts() const noexcept { return target_; }
    /// It has executed the block before the last one, and stands, as far as its blocks tell.
    [[nodiscard]] bool at_rest() const noexcept { return model_.velocity == 0.0 && model_.position == model_.target; }
    /// Where the drive is at the instant of the last block, as far as its blocks tell.
    [[nodiscard]] double position_counts() const noexcept { return model_.position; }
    [[nodiscard]] double velocity_counts_s() const noexcept { return model_.velocity; }
    [[nodiscard]] SetpointFrames& frames() noexcept { return frames_; }

private:
    /// What the drive was told, and what it makes of it.
    struct Move {
        double position = 0.0;
        double velocity = 0.0;
        double target = 0.0;
        double speed = 0.0;

        struct Phase {
            double duration_s = 0.0;
            double rate = 0.0;         // of the velocity
            double end_velocity = 0.0; // without rounding
            bool at_target = false;
        };
        [[nodiscard]] Phase phase(double ramp) const noexcept;
        void pass(double duration_s, double ramp) noexcept;
    };

    void commit() noexcept;
    [[nodiscard]] std::optional<double> velocity_to(double there, double period_s) const noexcept;
    [[nodiscard]] double beyond(double speed) const noexcept;
    void set_move(double target, double speed) noexcept;

    BlockSettings settings_;
    SetpointFrames frames_;
    double ramp_;          // as the register has it [counts/s^2]
    double slowest_ = 0.0; // the register's unit [counts/s]
    Move committed_;       // at previous_arrival_us_, as the block before the last one has it
    Move model_;           // at arrival_us_, by the same
    double target_ = 0.0;  // of the last block
    double speed_ = 0.0;
    std::uint64_t previous_arrival_us_ = 0;
    std::uint64_t arrival_us_ = 0; // when the last block arrives
    bool clamped_ = false;
    bool end_sent_ = false;
};

} // namespace splinefeed::hal::modbus
