// SPDX-License-Identifier: MIT
// ModalState: what stays in effect from block to block.
#pragma once

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"
#include "splinefeed/s0_program/words/block.hpp"
#include "splinefeed/s0_program/words/cutter_offset.hpp"
#include "splinefeed/s0_program/words/surface_speed.hpp"

#include "splinefeed/s1_blended_path/path_element.hpp"

namespace splinefeed {

enum class SpindleState : std::uint8_t { stopped, clockwise, counterclockwise };

struct ModalState {
    static constexpr std::int16_t no_motion = 800; ///< G80
    static constexpr std::int16_t lost_motion =
        30000; ///< one that was refused by name, where further errors are looked for

    std::int16_t motion = no_motion;       ///< ten times the G word
    std::int16_t before_cycle = no_motion; ///< the last one that was no cycle
    Plane plane = Plane::xy;
    bool inches = false;
    bool incremental = false;
    bool extruder_incremental = false; ///< M83
    bool centre_absolute = false;      ///< G90.1
    bool inverse_time = false;         ///< G93
    bool per_turn = false;             ///< G95
    bool diameter = false;             ///< G7: X is one
    bool feed_in_inches = false;       ///< F was
    bool retract_to_r = false;         ///< G99
    bool lathe_tool = false;           ///< the last T has the number of an offset: T0101
    bool needs_straight = false;       ///< behind G40 the tool is beside the programmed point
    CutterOffset cutter{};             ///< G41, G42
    PathMode path_mode = PathMode::continuous;
    SpindleState spindle = SpindleState::stopped;
    std::int16_t cutter_number = -1; ///< the last D, where it stays; -1: none
    std::int32_t selected_tool = 0;
    Decimal tolerance_mm{};
    Decimal chain_tolerance_mm{};
    Decimal feed{};  ///< mm/min or degrees/min; G93: 1/min; G95: mm or degrees a turn; 0: none yet
    Decimal speed{}; ///< S: 1/min; G96: m/min, in inches feet/min
    SurfaceSpeed surface{};

    /// Before the first block.
    [[nodiscard]] static ModalState at_start(const ProgramSettings& settings) noexcept;
    /// A motion word is in effect; G80: the one that it leaves.
    void set_motion(std::int16_t code, const DialectRules& rules) noexcept;
    /// What M2 and M30 leave: G1, G17, G40, G90, G94 and M5. Units, F, S and T stay.
    void end_program(const ProgramSettings& settings) noexcept;
    /// A length or a feed of the program in mm.
    [[nodiscard]] Decimal in_mm(Decimal value) const noexcept {
        return inches ? Decimal{product_quotient(value.raw, 254, 10).raw} : value;
    }
    /// A length in mm in the units of the program.
    [[nodiscard]] Decimal in_units(Decimal mm) const noexcept { return inches ? in_inches(mm) : mm; }
    /// F as the program states it: the units may have changed since.
    [[nodiscard]] Decimal feed_word() const noexcept { return feed_in_inches ? in_inches(feed) : feed; }
    /// A way of each turn of the spindle as a feed [mm/min]. False: beyond the range of feeds.
    [[nodiscard]] bool feed_of_turns(Decimal way, Decimal& out) const noexcept;
    /// Takes over the modes of a block: all but offsets and motion. Errors as BlockInterpreter::push.
    BlockStatus apply(const Block& block, const ProgramSettings& settings) noexcept;

    friend constexpr bool operator==(const ModalState&, const ModalState&) noexcept = default;

private:
    // Exact for what in_mm() made.
    [[nodiscard]] static Decimal in_inches(Decimal mm) noexcept { return {product_quotient(mm.raw, 10, 254).raw}; }
    BlockStatus apply_feed(const Block& block) noexcept;
    BlockStatus apply_speed(const Block& block, const ProgramSettings& settings) noexcept;
    BlockStatus apply_path_mode(const Block& block, const ProgramSettings& settings) noexcept;
};

/// Whether the block states a speed of the spindle: S of printers is also a temperature, or the time of a dwell or a
/// pause.
[[nodiscard]] bool states_speed(const Block& block, const DialectRules& rules) noexcept;

} // namespace splinefeed
