// SPDX-License-Identifier: MIT
// Any bytes as a machine file: a machine that the planner takes, or one line that says what is wrong.
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"

#include <cstdlib>
#include <string_view>

using namespace splinefeed;
using namespace splinefeed::host;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const MachineDescription machine = parse_machine({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
        if (!MotionLimits<Fixed>::make(machine.settings).has_value() ||
            !MotionLimits<float>::make(machine.settings).has_value() ||
            !MotionLimits<double>::make(machine.settings).has_value()) {
            std::abort();
        }
    } catch (const InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) {
            std::abort();
        }
    }
    return 0;
}
