// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/dialect_hint.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("A word of another dialect is told with the dialect that has it") {
    const std::string_view marlin = "this dialect does not have the word; --dialect marlin does";
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl}) {
        CHECK(dialect_hint("M104 S200", ProgramError::user_code_unsupported, dialect) == marlin);
        CHECK(dialect_hint("m 8 2", ProgramError::m_code_unknown, dialect) == marlin);
        CHECK(dialect_hint("E.5", ProgramError::word_unused, dialect).find("--dialect marlin") < 60);
        CHECK(dialect_hint("?", ProgramError::character_invalid, dialect).find("grbl takes this byte") == 0);
    }
    CHECK(dialect_hint("$X", ProgramError::character_invalid, Dialect::linuxcnc).find("--dialect grbl") < 60);
}

TEST_CASE("No advice changes what the program means") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::marlin}) { // W may be an axis of its own
        const std::string_view hint = dialect_hint("W-2.", ProgramError::axis_missing, dialect);
        CHECK(hint.find("the machine has no such axis") == 0);
        CHECK(hint.find("--") == std::string_view::npos);
    }
    CHECK(dialect_hint("M190 P2", ProgramError::user_code_unsupported, Dialect::linuxcnc).empty()); // of plasma
    CHECK(dialect_hint("M190P2Q1", ProgramError::user_code_unsupported, Dialect::grbl).empty());
    CHECK_FALSE(dialect_hint("M190 S60 (PQ)", ProgramError::user_code_unsupported, Dialect::linuxcnc).empty());
    CHECK(dialect_hint("M83", ProgramError::m_code_unknown, Dialect::fanuc).empty()); // its air jet
    CHECK(option_advice(ProgramError::not_in_dialect).find("--") == std::string_view::npos);
}

TEST_CASE("A decimal comma and prose are told as such") {
    CHECK(dialect_hint(",5 F600", ProgramError::character_invalid, Dialect::linuxcnc) ==
          "a number has a point, not a comma");
    CHECK(dialect_hint(", 5", ProgramError::character_invalid, Dialect::linuxcnc).empty());
    CHECK(dialect_hint("ello world", ProgramError::function_unknown, Dialect::grbl).find("the letter before it") == 0);
    CHECK(dialect_hint("SINE [1]", ProgramError::function_unknown, Dialect::linuxcnc).empty());
}

TEST_CASE("Tolerances and units are those of the dialect") {
    const auto hint = [](ProgramError error, Dialect dialect) {
        return std::string(dialect_hint("X", error, dialect));
    };
    CHECK(hint(ProgramError::arc_radius_mismatch, Dialect::linuxcnc).find("0.0283 mm") != std::string::npos);
    CHECK(hint(ProgramError::arc_radius_mismatch, Dialect::grbl).find("0.005 mm") != std::string::npos);
    CHECK(hint(ProgramError::arc_radius_mismatch, Dialect::klipper).find("by 0.5 mm") != std::string::npos);
    CHECK(hint(ProgramError::dwell_invalid, Dialect::marlin).find("milliseconds") != std::string::npos);
    CHECK(hint(ProgramError::dwell_invalid, Dialect::grbl).find(" seconds") != std::string::npos);
}

TEST_CASE("What no dialect has gets no hint") {
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl, Dialect::marlin}) {
        CHECK(dialect_hint("M123", ProgramError::user_code_unsupported, dialect).empty());
        CHECK(dialect_hint("M862.3", ProgramError::m_code_unknown, dialect).empty());
        CHECK(dialect_hint("M", ProgramError::m_code_unknown, dialect).empty());
        CHECK(dialect_hint("Q1", ProgramError::word_unused, dialect).empty());
        CHECK(dialect_hint("\xe9", ProgramError::character_invalid, dialect).empty());
        CHECK(dialect_hint("", ProgramError::character_invalid, dialect).empty());
        CHECK(dialect_hint("M104", ProgramError::number_invalid, dialect).empty());
    }
    CHECK(dialect_hint("M104", ProgramError::user_code_unsupported, Dialect::marlin).empty());
    CHECK(dialect_hint("U1", ProgramError::axis_missing, Dialect::fanuc).empty());
    CHECK(dialect_hint("A1", ProgramError::axis_missing, Dialect::linuxcnc).empty());
    CHECK(dialect_hint("E1", ProgramError::word_unused, Dialect::marlin).empty());
}
