// SPDX-License-Identifier: MIT
// dialect_rules: where the controllers of the dialects differ beside their words.
#pragma once

#include "splinefeed/s0_program/dialects/program_settings.hpp"

namespace splinefeed {

/// What G4 and the dwells of cycles mean by P. S, X and U count seconds wherever G4 takes them.
enum class DwellUnit : std::uint8_t { second, millisecond };

/// When the two radii of an arc are too far apart: by more than `least` and by more than 0.1 % of the larger one, or
/// by more than `most`. [mm]
struct ArcTolerance {
    Decimal least{};
    Decimal most{};
    bool relative = true; ///< false: only `most` counts
};

/// docs/reference/gcode.md names for each rule the place in the controller's source.
struct DialectRules {
    // Text.
    bool open_comments = false; ///< a '(' may lack its ')', and '(' may stand in a comment
    bool checksums = false;     ///< *71 at the end of a line
    bool bare_letters = false;  ///< a letter may lack its number
    bool one_command = false;   ///< an M word behind the first G or M word is not read; words of a printer's M are free
    bool skips_unknown = false; ///< unknown M words are left out with their line, as the controller does
    bool dollar_lines = false;  ///< $ begins a command of the controller
    bool polar_words = false;   ///< @ and ^
    bool mills_only = false;    ///< words of a lathe's program refuse it
    bool uvw_steps = false;     ///< U V W are steps along X Y Z, where the machine has no such axes
    bool macros = false;        ///< expressions are those of Fanuc's custom macro B: a parameter may be vacant
    // Words.
    bool units_before_feed = false;     ///< G20 and G21 act on F of their own block
    bool lead_is_feed = false;          ///< F of G33 is the way of a turn
    bool extruder = false;              ///< E is an axis
    bool motion_beside_offsets = false; ///< G0 to G3 beside G28 and others are modes only
    bool g53_incremental = false;       ///< G53 under G91, too: it is absolute
    bool free_third_offset = false;     ///< an arc may have the one of I J K that is across its plane
    bool turns_before_arc = false;      ///< P of an arc counts whole circles before it
    bool small_radius = false;          ///< R below half of the chord is a half circle
    bool bare_g92 = false;              ///< G92 without axes: all stand at 0
    bool g28_homes = false;             ///< G28 is homing, and ends the shift of G92 for its axes
    bool rapid_has_feed = false;        ///< G0 has the feed F
    bool feed_of_all_axes = false;      ///< F counts all axes of a move, a degree as a unit of length
    bool degree_is_mm = false;          ///< and an inch per minute is 25.4 degrees per minute
    bool speed_stops = true;            ///< S waits for standstill; engravers change the power while they move
    bool dwell_words = false;           ///< G4 takes X or U, too
    bool dwell_speed = false;           ///< G4 and pauses take S as a time
    DwellUnit dwell = DwellUnit::second;
    bool dwell_point_seconds = false; ///< P with a decimal point is in seconds
    bool retracts_to_r = false;       ///< cycles begin in G99, others in G98
    bool cycles_apart = false;        ///< cycles are of a group of their own: G80 leaves the motion from before them
    bool idle_cycles = false;         ///< a cycle takes P, and without repeats (L0) it makes no hole
    bool keeps_cutter_number = false; ///< D stays for the next G41, and may stand before it
    std::int16_t first_motion = 0;    ///< in effect before the first block: ten times the G word; 800: none
    std::int16_t last_motion = 10;    ///< and behind M2 and M30
    Decimal first_feed{};             ///< before any F [mm/min]
    ArcTolerance arc{};               ///< in mm
    ArcTolerance arc_in_inches{};     ///< under G20, in mm, too
};

/// @param dialect  one of Dialect
[[nodiscard]] const DialectRules& rules_of(Dialect dialect) noexcept;

} // namespace splinefeed
