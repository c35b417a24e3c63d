// SPDX-License-Identifier: MIT
// GcodeSettings: how a program in G-code is to be read, and for which machine.
#pragma once

#include "host_sim/config/program_pins.hpp"
#include "host_sim/config/spindle_description.hpp"
#include "host_sim/program/tool_file.hpp"

#include "splinefeed/number/position.hpp"
#include "splinefeed/s0_program/dialects/program_settings.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// As they were typed.
struct GcodeArguments {
    std::optional<std::string> dialect;
    std::optional<std::string> ignore;
    std::optional<std::string> tools;
    std::optional<std::string> subprograms;
    std::optional<std::string> repeat;
    bool block_delete = false;
    bool optional_stop = false;
    bool increments = false;
};

class LeftOutList;

/// Who says the dialect.
enum class DialectChoice : std::uint8_t { nobody, option, first_lines };

struct GcodeSettings {
    Dialect dialect = Dialect::linuxcnc;
    DialectChoice dialect_choice = DialectChoice::nobody;
    std::string dialect_guess; ///< the dialect that they look like if it is another one, and why; else empty
    std::vector<IgnoredWord> ignored;
    std::vector<std::string> ignored_lines; ///< by their first words; a * at the end is any rest
    bool ignores_unknown = false;           ///< words and lines that the dialect does not have
    bool increments = false;                ///< lengths without a decimal point count 0.001 mm, in inches 0.0001
    LeftOutList* left_out = nullptr;        ///< gets what was left out; null: nobody asks
    std::optional<ToolRows> tools;          ///< none: G43 and G43 H are refused
    bool block_delete = false;
    bool optional_stop = false;
    bool simulated = true;                         ///< a simulated machine has a spindle, coolant, and everything else
    const SpindleDescription* spindle = nullptr;   ///< of the machine; null: its file says nothing of one
    const ProgramPins* lines = nullptr;            ///< coolant and outputs of the machine; null: it has none
    double tolerance_mm = 0.01;                    ///< of G64 without P
    int chain_quarters = 3;                        ///< of P, for the chains of G64 without Q
    double rapid_tolerance_mm = 0.1;               ///< between rapids
    double max_feed_mm_s = 0.0;                    ///< of moves with a feed, along the linear axes; 0: none
    std::uint32_t rotary_axes = 0;                 ///< bit k: axis k of the machine is rotary
    std::vector<std::string> axes;                 ///< names: x, y, z, a, b, c
    std::uint64_t most_moves = 0;                  ///< the program ends behind them; 0: all count
    std::uint64_t runs = 1;                        ///< of a program that M99 ends
    std::vector<std::string> subprogram_folders{}; ///< in the order of search; an empty text is the working one
    std::optional<WorkOffsets> offsets{};          ///< of a state file
    PerAxis<Position> start{};                     ///< where the machine stands, in its own coordinates
};

/// The names of --dialect.
inline constexpr std::string_view dialect_names[] = {"linuxcnc", "grbl", "marlin", "fanuc", "klipper", "auto"};

[[nodiscard]] constexpr std::string_view dialect_name(Dialect dialect) noexcept {
    return dialect_names[static_cast<unsigned>(dialect)];
}

/// Whether one of the options was given; its name, else empty.
[[nodiscard]] std::string_view first_option(const GcodeArguments& arguments) noexcept;

/// What was typed. Throws UsageError.
[[nodiscard]] GcodeSettings read_gcode_arguments(const GcodeArguments& arguments);

} // namespace splinefeed::host
