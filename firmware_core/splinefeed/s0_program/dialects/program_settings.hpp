// SPDX-License-Identifier: MIT
// ProgramSettings: what an interpreter has to know of the machine and of the program's dialect.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s0_program/text/decimal.hpp"

#include <cstddef>
#include <string_view>

namespace splinefeed {

/// Whose words they are. linuxcnc is RS274/NGC with LinuxCNC's additions.
enum class Dialect : std::uint8_t {
    linuxcnc,
    grbl,    ///< grbl 1.1: no canned cycles, expressions, splines; $ lines are refused; $H as G28 of all axes
    marlin,  ///< printers: E, M82, M83, G28 is homing, G92 E0, heaters and fans, ';' comments, G0 takes F
    fanuc,   ///< as CAM systems write it: safe lines, G28 U W, dwells in ms; LinuxCNC's words otherwise
    klipper, ///< printers: Marlin's words, G92 alone; macros are the host's
};

/// The length of a tool, and where its tip is; in the axes of the machine.
struct ToolOffset {
    PerAxis<Decimal> offset{}; ///< [mm or degrees]
    Decimal diameter{};
    std::int32_t orientation = 0; ///< of a lathe tool's tip, 1 to 9 as LinuxCNC has it; 0: a mill
};

/// The tool table of the machine.
class ToolTable {
public:
    /// False: there is no such tool.
    [[nodiscard]] virtual bool find(std::int32_t tool, ToolOffset& out) const noexcept = 0;

protected:
    ~ToolTable() = default;
};

/// A word that the program may have without being followed: {'M', 1040} is M104, {'E', any} every E.
struct IgnoredWord {
    static constexpr std::int16_t any = -1;
    char letter = 'M';
    std::int16_t tenths = any; ///< ten times the number of the word
};

/// Is told each word that a program has and that is not followed, as it stands in the line.
class LeftOutWords {
public:
    virtual void add(std::string_view word) noexcept = 0;

protected:
    ~LeftOutWords() = default;
};

class WordExtension;

struct ProgramSettings {
    int axes = 3;
    /// The letter of each machine axis: X Y Z A B C U V W, or E in Dialect::marlin. A, B and C are in degrees.
    std::array<char, static_cast<unsigned>(max_axes)> letters {
#if SPLINEFEED_MAX_AXES >= 3
        'X', 'Y', 'Z'
#else
        'X'
#endif
    };
    /// Bit k: axis k is rotary for the feed plan, too (MachineSettings: rotary), which then counts the other axes
    /// itself. Without it the plan's feed is along the path in all axes, and feeds are converted to that.
    std::uint32_t rotary_axes = 0;
    Dialect dialect = Dialect::linuxcnc;
    bool block_delete = false;    ///< lines that begin with / are left out
    bool optional_pause = true;   ///< M1 pauses
    bool numbered = false;        ///< items have the number N of their line, where that is above 0
    bool ignores_unknown = false; ///< words that the dialect does not have are left out
    bool increments = false;      ///< lengths without a decimal point count 0.001 mm, in inches 0.0001
    int chain_quarters = 3;       ///< quarters of P that are Q of G64 where a program states none
    Decimal default_tolerance_mm{Decimal::one / 100}; ///< of G64 without P, and before the first of G61, G61.1, G64
    Decimal rapid_tolerance_mm{Decimal::one / 10};    ///< between two rapids in G64
    const IgnoredWord* ignored = nullptr;
    std::size_t ignored_count = 0;
    Decimal most_speed = Decimal::from_integer(100000); ///< of the spindle by G96 without D [1/min]
    LeftOutWords* left_out = nullptr;                   ///< none: nobody asks
    const ToolTable* tools = nullptr;                   ///< none: G43, G41 and G42 are refused
    WordExtension* extension = nullptr; ///< Dialect::fanuc: coordinates of G52, G54.1, G68 and others; none: refused
};

} // namespace splinefeed
