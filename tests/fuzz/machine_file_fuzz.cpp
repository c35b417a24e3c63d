// SPDX-License-Identifier: MIT
// Any bytes as a machine file: a machine that the planner takes, or one line that says what is wrong.
#include "fuzz/require.hpp"
#include "host_sim/config/machine_file.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return splinefeed_test::read_or_refuse(data, size, [](std::string_view text) {
        const MachineDescription machine = parse_machine(text, "fuzz.toml");
        splinefeed_test::require(MotionLimits<Fixed>::make(machine.settings).has_value() &&
                                 MotionLimits<float>::make(machine.settings).has_value() &&
                                 MotionLimits<double>::make(machine.settings).has_value());
    });
}
