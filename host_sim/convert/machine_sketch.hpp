// SPDX-License-Identifier: MIT
// MachineSketch: what another controller's file says of a machine, before it becomes a machine file.
#pragma once

#include "host_sim/convert/source_value.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinefeed::host {

/// A key of a machine file with its value, and what says it.
struct SketchRow {
    std::string key;
    std::string value;  ///< as TOML has it
    std::string source; ///< a comment behind it; empty: none
};

struct SketchAxis {
    std::string name; ///< "x"
    bool rotary = false;
    std::vector<SketchRow> rows;

    /// Also of a row that is a comment: the file says something of it.
    [[nodiscard]] const SketchRow* find(std::string_view key) const;
};

struct MachineSketch {
    std::string made_of; ///< "an answer to $$"
    std::string name;
    std::vector<SketchRow> head;
    std::vector<SketchRow> path;
    std::vector<SketchRow> step;
    std::vector<SketchRow> spindle;
    std::vector<SketchAxis> axes;
    std::vector<std::pair<std::string, std::string>> rest; ///< what is no key: what says it, and what is said of it

    /// Of a machine that states no limit along its path: that of its fastest axis, in mm where there is one.
    void limit_path_by_axes();
};

/// "line 12: [AXIS_X] MAX_VELOCITY = 50"
[[nodiscard]] std::string source_of(const SourceValue& value);

/// A name of a machine: without what TOML would take for its own.
[[nodiscard]] std::string plain_name(std::string_view text);
/// The file's name without its folder and suffix, as a name of a machine.
[[nodiscard]] std::string name_of_source(const std::string& file);

/// A machine file; what it cannot say is a comment at its end.
[[nodiscard]] std::string machine_text(const MachineSketch& sketch);

} // namespace splinefeed::host
