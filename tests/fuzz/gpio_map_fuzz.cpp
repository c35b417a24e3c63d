// SPDX-License-Identifier: MIT
// Any bytes as a map file: a map whose lines are all there and each once, or one line that says what is wrong.
#include "fuzz/require.hpp"
#include "host_sim/config/gpio_map.hpp"
#include "host_sim/config/machine_file.hpp"

#include <set>
#include <utility>

using namespace splinefeed::hal::gpio;
using namespace splinefeed::host;
using splinefeed_test::require;

namespace {

// Inputs may share a line; what shares one acts at one level, and is not the same input again.
void require_agree(const MappedInput& input, const MappedInput& other) {
    if (input.line == other.line) {
        require(input.active_level == other.active_level);
        require(input.role != other.role || input.axis != other.axis);
    }
}

void require_sound(const PinMap& map, const MachineDescription& machine) {
    std::set<std::pair<unsigned, unsigned>> outputs;
    const auto output = [&](PinBit line) {
        require(line.chip < map.chips.size() && line.bit < map.chips[line.chip].outputs.size());
        require(outputs.insert({line.chip, line.bit}).second);
    };
    for (const unsigned k : splinefeed::indices(machine.settings.axes)) {
        require(map.axis[k].motors == static_cast<unsigned>(machine.motors[k].count));
        for (unsigned m = 0; m < map.axis[k].motors; ++m) {
            output(map.axis[k].motor[m].step);
            output(map.axis[k].motor[m].direction);
        }
        require(!map.home[k] || map.home[k]->latch_mm_s <= map.home[k]->seek_mm_s);
    }
    if (map.enable) {
        output(map.enable->line);
    }
    for (std::size_t k = 0; k < map.inputs.size(); ++k) {
        const MappedInput& input = map.inputs[k];
        require(input.line.chip < map.chips.size() && input.line.bit < map.chips[input.line.chip].inputs.size());
        require(input.axis < machine.settings.axes);
        for (std::size_t other = 0; other < k; ++other) {
            require_agree(input, map.inputs[other]);
        }
    }
    for (const ChipPins& chip : map.chips) {
        require(chip.outputs.size() <= most_lines && chip.inputs.size() <= most_lines);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MachineDescription machine = default_machine();
    return splinefeed_test::read_or_refuse(data, size, [](std::string_view text) {
        require_sound(parse_gpio_map(text, "fuzz.toml", machine, "/dev/gpiochip0"), machine);
    });
}
