// SPDX-License-Identifier: MIT
// SavedModes: the modes of a program as M70 and M73 save them, and the lines that put them back.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// What the events of a program have switched on.
struct CoolantState {
    bool mist = false;
    bool flood = false;
};

/// All but the motion word, as in LinuxCNC (interp_convert.cc, gen_settings and gen_m_codes).
struct SavedModes {
    ModalState modal{};
    WorkOffsets offsets{}; ///< which are in effect; their values are not put back, but of the tool
    CoolantState coolant{};
};

/// The lines that make `saved` of `now`, without what is the same. Cutter compensation can be ended by them alone.
/// @param axes  of the machine: x, y, z, ...
[[nodiscard]] std::vector<std::string> restoring_lines(const SavedModes& saved, const SavedModes& now,
                                                       const std::vector<std::string>& axes);

} // namespace splinefeed::host
