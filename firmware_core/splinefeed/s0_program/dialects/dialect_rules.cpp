// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/dialects/dialect_rules.hpp"

#include <array>

namespace splinefeed {

namespace {

// In a struct: its names stay in it where sources are compiled as one.
struct DialectTable {
    static constexpr Decimal half_mm{Decimal::one / 2};

    // 2 * sqrt(2) hundredths of a mm, thousandths of an inch; a hundred times that is too much in any case.
    static constexpr ArcTolerance arc_linuxcnc{{28'284'271}, {2'828'427'125}, true};
    static constexpr ArcTolerance arc_linuxcnc_inches{{71'842'049}, {7'184'204'897}, true};
    static constexpr ArcTolerance arc_grbl{{Decimal::one / 200}, half_mm, true};
    static constexpr ArcTolerance arc_printer{{}, half_mm, false};

    static constexpr DialectRules linuxcnc{
        .polar_words = true,
        .retracts_to_r = true,
        .first_motion = 800,
        .arc = arc_linuxcnc,
        .arc_in_inches = arc_linuxcnc_inches,
    };

    static constexpr DialectRules grbl{
        .open_comments = true,
        .dollar_lines = true,
        .units_before_feed = true,
        .g53_incremental = true,
        .free_third_offset = true,
        .feed_of_all_axes = true,
        .degree_is_mm = true,
        .speed_stops = false,
        .arc = arc_grbl,
        .arc_in_inches = arc_grbl,
    };

    static constexpr DialectRules printer{
        .checksums = true,
        .bare_letters = true,
        .one_command = true,
        .skips_unknown = true,
        .extruder = true,
        .free_third_offset = true,
        .g28_homes = true,
        .rapid_has_feed = true,
        .speed_stops = false,
        .dwell = DwellUnit::millisecond,
        .first_feed = Decimal::from_integer(1500),
        .arc = arc_printer,
        .arc_in_inches = arc_printer,
    };
    static constexpr DialectRules marlin = [] {
        DialectRules rules = printer;
        rules.turns_before_arc = rules.small_radius = rules.dwell_speed = true;
        return rules;
    }();
    static constexpr DialectRules klipper = [] {
        DialectRules rules = printer;
        rules.bare_g92 = true;
        return rules;
    }();

    // Its controls state no tolerance in public; LinuxCNC's is that of the same decimals.
    static constexpr DialectRules fanuc{
        .mills_only = true,
        .uvw_steps = true,
        .macros = true,
        .lead_is_feed = true,
        .motion_beside_offsets = true,
        .feed_of_all_axes = true,
        .dwell_words = true,
        .dwell = DwellUnit::millisecond,
        .dwell_point_seconds = true,
        .cycles_apart = true,
        .idle_cycles = true,
        .keeps_cutter_number = true,
        .first_motion = 800,
        .arc = arc_linuxcnc,
        .arc_in_inches = arc_linuxcnc_inches,
    };

    static constexpr std::array all{linuxcnc, grbl, marlin, fanuc, klipper}; // in the order of Dialect
};

} // namespace

const DialectRules& rules_of(Dialect dialect) noexcept {
    return DialectTable::all[static_cast<unsigned>(dialect)];
}

} // namespace splinefeed
