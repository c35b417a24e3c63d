// SPDX-License-Identifier: MIT
// machine_source: machine files of other controllers' files.
#pragma once

#include "host_sim/convert/machine_answers.hpp"
#include "host_sim/convert/machine_sketch.hpp"

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// A kind of file of another controller.
struct MachineSource {
    std::string_view name; ///< of --from
    std::string_view what; ///< "an answer of grbl to $$"
    bool (*looks_like)(std::string_view text);
    MachineSketch (*read)(std::string_view text, const std::string& file, MachineAnswers& answers);
};

/// The first one that the text looks like; null: none.
[[nodiscard]] const MachineSource* find_machine_source(std::string_view text);
/// Of that name. Empty or "auto": as the text looks. Throws UsageError where there is none, InputError where the text
/// looks like none.
[[nodiscard]] const MachineSource& machine_source(std::string_view name, std::string_view text,
                                                  const std::string& file);
/// "grbl, linuxcnc, klipper, marlin"
[[nodiscard]] std::string machine_source_names();

/// Reads, and asks for what is not said.
[[nodiscard]] MachineSketch read_machine(const MachineSource& source, std::string_view text, const std::string& file,
                                         MachineAnswers& answers);

} // namespace splinefeed::host
