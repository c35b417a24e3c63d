// SPDX-License-Identifier: MIT
// BlockStream: converts one axis of a motion to positioning blocks that replace each other on the fly.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

struct BlockSettings {
    int axis = 0;                    ///< index in the feed segments
    std::uint32_t period_us = 10000; ///< between two blocks
    /// If no new block arrives, the drive continues at its speed for this long beyond a period before it brakes; 0: one
    /// period.
    std::uint32_t reserve_us = 0;
    /// Acceleration of the drive's ramps [counts/s^2]: written if the profile has fields for it, else the drive's
    /// setting. It should be four times that of the path or more. Then the drive reaches a speed within a quarter of a
    /// period, and a speed error falls to a third with each block.
    double acceleration = 1e6;
    /// Highest speed of a drive that catches up, unless the path is faster [counts/s]; 0: the path's speed plus what
    /// the ramp reaches in a period.
    double fastest = 0.0;
};

/// Each block has the speed that brings the drive to the path a period later, and a target further ahead, so that the
/// drive does not brake in between. A model of the drive, with speeds and ramps rounded as in its registers, follows
/// the blocks, so errors do not accumulate.
///
/// Deviation from the path with one block per period: line_deviation_counts, plus period * half a unit of the speed's
/// register, plus half a unit of the position's. If the link fails, the drive stops by itself on a straight line,
/// within speed * (period + reserve) plus its braking distance.
class BlockStream {
public:
    /// The profile must outlive the stream. @pre the profile streams blocks
    BlockStream(const DriveProfile& profile, const BlockSettings& settings);

    /// Sets the position at which the drive stands.
    void begin(double position_counts) noexcept;
    /// Returns the frames of a block; the last frame arrives at this instant. @pre the track is not empty; instants do
    /// not decrease
    [[nodiscard]] std::span<const RegisterWrite> block(const TrajectoryBuffer& track,
                                                       const MotionInstant& instant) noexcept;
    /// The same for a motion at full rate.
    [[nodiscard]] std::span<const RegisterWrite> block(const TrajectoryBuffer& track,
                                                       std::uint64_t arrival_us) noexcept {
        return block(track, {arrival_us, arrival_us, arrival_us + settings_.period_us});
    }
    /// Returns frames that set all constant values and keep the drive at its position. Send them before the motion, so
    /// that the first block is as short as the others.
    [[nodiscard]] std::span<const RegisterWrite> prime() noexcept;
    /// Corrects the arrival of the last block; UINT64_MAX: it did not arrive, and the block before it continues.
    /// Without a call it counts as arrived in time.
    void on_arrival(std::uint64_t arrival_us) noexcept;
    /// Whether a target or a speed exceeded the range of its register.
    [[nodiscard]] bool clamped() const noexcept { return clamped_; }
    /// Whether the last block leads to the end of the motion.
    [[nodiscard]] bool end_sent() const noexcept { return end_sent_; }
    /// Returns the last frames again, with another start of the move.
    [[nodiscard]] std::span<const RegisterWrite> repeat() noexcept { return frames_.build(); }
    /// Target of the last block.
    [[nodiscard]] double target_counts() const noexcept { return target_; }
    /// Whether, by the model, the drive has executed the block before the last one and stands.
    [[nodiscard]] bool at_rest() const noexcept { return model_.velocity == 0.0 && model_.position == model_.target; }
    /// Position of the drive at the instant of the last block, by the model.
    [[nodiscard]] double position_counts() const noexcept { return model_.position; }
    [[nodiscard]] double velocity_counts_s() const noexcept { return model_.velocity; }
    [[nodiscard]] SetpointFrames& frames() noexcept { return frames_; }

private:
    /// A block and the drive's motion on it.
    struct Move {
        double position = 0.0;
        double velocity = 0.0;
        double target = 0.0;
        double speed = 0.0;

        struct Phase {
            double duration_s = 0.0;
            double rate = 0.0;         // rate of change of the velocity
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
    double ramp_;          // rounded as in the register [counts/s^2]
    double slowest_ = 0.0; // unit of the speed's register [counts/s]
    Move committed_;       // state at previous_arrival_us_, by the block before the last one
    Move model_;           // state at arrival_us_, by the same block
    double target_ = 0.0;  // of the last block
    double speed_ = 0.0;
    std::uint64_t previous_arrival_us_ = 0;
    std::uint64_t arrival_us_ = 0; // arrival of the last block
    bool clamped_ = false;
    bool end_sent_ = false;
};

} // namespace splinefeed::hal::modbus
