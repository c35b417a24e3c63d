// SPDX-License-Identifier: MIT
// PinChanges: collects level changes for the lines of all chips and writes them together.
#pragma once

#include "splinefeed/hal/gpio/pin_writer.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include <vector>

namespace splinefeed::hal::gpio {

/// Lines of one chip that change together, and which of them are inverted.
struct LevelMasks {
    std::uint64_t mask = 0;
    std::uint64_t inverted = 0; ///< lines of the mask that are low when the level is true
};

/// A chip's outputs.
struct ChipOutputs {
    PinWriter* writer = nullptr; ///< must outlive the port
    PerAxis<LevelMasks> step{};
    PerAxis<LevelMasks> direction{};
    LevelMasks enable{}; ///< level true: drives enabled
    LevelMasks brake{};  ///< level true: brake released
};

/// For one thread at a time. Allocates in its constructor only.
class PinChanges {
public:
    PinChanges(std::vector<ChipOutputs> chips, int axes, bool step_on_edge)
        : chips_(std::move(chips)), change_(chips_.size()), axes_(axes), step_on_edge_(step_on_edge) {}

    /// Prepares for another motion, whose edges assume low step lines and negative directions. Drops collected changes.
    void begin() noexcept;
    /// Forgets collected changes: the lines keep what was written.
    void drop() noexcept;
    void add(const Edge& edge) noexcept;
    /// Writes collected changes with one call per chip. Returns false if a chip failed, with errno; the others are
    /// written.
    [[nodiscard]] bool write() noexcept;
    /// Enables or disables the drives, together with the collected changes; step lines become idle. Enabling sets all
    /// directions negative, as every motion begins; disabling also engages the brake.
    [[nodiscard]] bool enable(bool on) noexcept;
    /// Releases or engages the brake, together with the collected changes.
    [[nodiscard]] bool brake(bool released) noexcept;
    /// The axis's last direction; true: positive.
    [[nodiscard]] bool up(unsigned axis) const noexcept { return now_.up[axis]; }

private:
    struct Change {
        std::uint64_t mask = 0;
        std::uint64_t levels = 0;
    };

    void take(std::size_t chip, const LevelMasks& lines, bool level) noexcept;

    std::vector<ChipOutputs> chips_;
    std::vector<Change> change_; // of each chip
    int axes_;
    bool step_on_edge_;
    struct Levels {
        PerAxis<bool> up{};
        PerAxis<bool> step{}; // of the step line, with step_on_edge
    };
    Levels now_;           // with the collected changes
    Levels written_;       // without them
    PerAxis<bool> base_{}; // of the step line at the start of the motion
};

} // namespace splinefeed::hal::gpio
