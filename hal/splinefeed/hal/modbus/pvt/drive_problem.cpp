// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"

namespace splinefeed::hal::modbus {

DriveProblem identity_problem(const PvtIdentity& identity, int least_axes) noexcept {
    if (identity.magic != pvt::magic) {
        return DriveProblem::not_pvt;
    }
    if (identity.version != pvt::version) {
        return DriveProblem::version;
    }
    if (identity.check_32 == swapped_words(pvt::word_check_32)) {
        return DriveProblem::words_swapped;
    }
    if (identity.check_32 != pvt::word_check_32 || identity.check_16 != pvt::word_check_16 || identity.axes < 1 ||
        identity.axes > max_axes) {
        return DriveProblem::not_pvt;
    }
    if (identity.axes < least_axes) {
        return DriveProblem::axes;
    }
    if (identity.ring < pvt::shortest_ring) {
        return DriveProblem::ring;
    }
    return identity.ticks_per_s != ticks_per_s ? DriveProblem::ticks : DriveProblem::none;
}

std::string fault_text(const PvtStatus& status, const std::vector<std::string>& axis_names) {
    const std::size_t axis = status.fault_axis;
    return "code " + std::to_string(status.fault) + " on " +
           (axis < axis_names.size() ? axis_names[axis] : "its axis " + std::to_string(axis)) + ": " +
           fault_name(status.fault);
}

const char* describe(DriveProblem problem) noexcept {
    switch (problem) {
    case DriveProblem::none: return "nothing is wrong";
    case DriveProblem::unreachable: return "there is no connection";
    case DriveProblem::silent: return "it does not answer";
    case DriveProblem::damaged:
        return "it answers, but the checksum of its status is always wrong, or its registers change from one reading "
               "to the next; check the cable, and the drive's own checksum (docs/reference/pvt_map.md)";
    case DriveProblem::not_kept:
        return "it does not keep its configuration as written (docs/reference/pvt_map.md: stop reserve, watchdog, "
               "following error window)";
    case DriveProblem::not_pvt: return "it does not have the map splinefeed-pvt; name its profile";
    case DriveProblem::words_swapped:
        return "its 32-bit numbers have the low word first; splinefeed-pvt has the high word first: change that "
               "setting of the drive or the gateway";
    case DriveProblem::version: return "its map does not have version 1; bring the drive or splinefeed up to date";
    case DriveProblem::axes:
        return "it has fewer axes than the machine needs; name a drive with enough axes, or a machine file (-m) with "
               "fewer";
    case DriveProblem::ticks: return "its ticks are not 1/8 us, as version 1 of the map requires";
    case DriveProblem::power_cycled: return "it was switched off and on; segments that it had not executed are lost";
    case DriveProblem::fault: return "it is in fault";
    case DriveProblem::refused: return "it refuses commands or segments repeatedly";
    case DriveProblem::out_of_step:
        return "it reports segments that were never sent; another master may be on the line";
    case DriveProblem::ignores: return "it answers, but neither executes nor refuses a command; check its firmware";
    case DriveProblem::unknown_state:
        return "it reports a state that the map does not have (docs/reference/pvt_map.md: 0 to 6)";
    case DriveProblem::switched_off:
        return "its power is off, and splinefeed did not switch it off; look for who did: a panel, an input, a program";
    case DriveProblem::busy:
        return "another program moves it or exchanges data with it; wait until that one has ended, or end it";
    case DriveProblem::taken:
        return "somebody else ended the session of this run: another program, a panel; let only one use the drive";
    case DriveProblem::takes_nothing:
        return "it stands ready, but accepts no more segments; check its register free and its ring";
    case DriveProblem::frozen: return "it is to run, but executes no segments; check its enable input and its clock";
    case DriveProblem::unfinished: return "it has executed all segments, but does not report that it stands";
    case DriveProblem::not_standing: return "it does not report that it stands";
    case DriveProblem::ring:
        return "its ring holds fewer than the 16 segments that the map requires; enlarge it in the drive's settings";
    case DriveProblem::overrun:
        return "splinefeed had more segments for it than there was room for, and stopped; please report this defect";
    case DriveProblem::range:
        return "the program exceeds the range of its map: 2^31 counts of position, 2^23 counts a segment; lower "
               "steps_per_mm, and the drive's counts with it";
    case DriveProblem::moves: return "it moves already; end the program that moves it, or wait until it stands";
    case DriveProblem::not_homed:
        return "its homing was not completed within five minutes; check its switches and its settings";
    case DriveProblem::interrupted: return "its homing was interrupted, so its position is not known";
    }
    return "";
}

} // namespace splinefeed::hal::modbus
