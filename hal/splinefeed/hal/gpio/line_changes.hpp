// SPDX-License-Identifier: MIT
// LineChanges: what edges change on the lines of all chips, collected and written at once.
#pragma once

#include "splinefeed/hal/gpio/line_writer.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include <vector>

namespace splinefeed::hal::gpio {

/// Of one chip: the lines that an axis's edges change, and those that the levels of the edge invert.
struct LevelMasks {
    std::uint64_t mask = 0;
    std::uint64_t inverted = 0; ///< of the mask: low where the level is true
};

/// A chip's outputs.
struct ChipOutputs {
    LineWriter* writer = nullptr; ///< outlives the port
    PerAxis<LevelMasks> step{};
    PerAxis<LevelMasks> direction{};
    LevelMasks enable{}; ///< level true: the drives are on
    LevelMasks brake{};  ///< level true: it is released
};

/// Used by one thread at a time. It allocates when it is made, and never again.
class LineChanges {
public:
    LineChanges(std::vector<ChipOutputs> chips, int axes, bool step_on_edge)
        : chips_(std::move(chips)), change_(chips_.size()), axes_(axes), step_on_edge_(step_on_edge) {}

    /// Another motion, which takes its step lines for low and its directions for down. Drops what is collected.
    void begin() noexcept;
    void drop() noexcept;
    void add(const Edge& edge) noexcept;
    /// One call a chip. False: a chip did not take it, errno says why; all others did.
    [[nodiscard]] bool write() noexcept;
    /// Writes with what is collected: drives on or off, steps idle; on: directions down, where every motion begins;
    /// off: the brake is engaged with it.
    [[nodiscard]] bool enable(bool on) noexcept;
    /// Writes with what is collected: the brake is released or engaged.
    [[nodiscard]] bool brake(bool released) noexcept;
    /// The axis's last direction.
    [[nodiscard]] bool up(unsigned axis) const noexcept { return up_[axis]; }

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
    PerAxis<bool> up_{};
    PerAxis<bool> level_{}; // of the step line, with step_on_edge
    PerAxis<bool> base_{};  // the same where the motion began
};

} // namespace splinefeed::hal::gpio
