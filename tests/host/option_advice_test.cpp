// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/dialect_hint.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Where an option helps, it stands behind the core's sentence") {
    CHECK(option_advice(ProgramError::not_in_dialect) == "; that of linuxcnc has it");
    CHECK(option_advice(ProgramError::bed_levelling_unsupported) == "; --ignore G29 leaves it out");
    CHECK(option_advice(ProgramError::user_code_unsupported).find("--ignore") < 3);
    CHECK(option_advice(ProgramError::number_invalid).empty());
}
