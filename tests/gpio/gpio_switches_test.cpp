// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/pin_outputs.hpp"

#include "host_sim/config/machine_file.hpp"
#include "recorded_chips.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr const char* machine_text = R"(
[path]
max_feed_mm_s = 80
[lines]
chip = "/dev/gpiochip0"
[coolant]
mist = { line = "MIST" }
flood = { line = 5, active = "low" }
[[output]]
number = 0
line = { chip = "/dev/gpiochip1", name = "CLAMP" }
safe = "on"
[[output]]
number = 7
line = "DOOR"
[[axis]]
name = 'x'
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
)";

/// Bits: chip 0 has mist, flood and door, chip 1 the clamp.
struct Bench {
    [[nodiscard]] std::uint64_t levels(std::size_t chip) const { return chips.chip[chip]->rows().back().levels; }

    MachineDescription machine = parse_machine(machine_text, "m.toml");
    RecordedChips chips{machine.lines};
    std::shared_ptr<OutputPart> switches = pin_outputs(machine, chips.all).front();
};

constexpr std::uint64_t mist = 1;
constexpr std::uint64_t flood_off = 2; // it is low when it acts
constexpr std::uint64_t door = 4;
constexpr std::uint64_t clamp = 1;

} // namespace

TEST_CASE("Coolant and outputs are lines with a level each, and safe at the end", "[switches]") {
    Bench bench;
    REQUIRE(bench.chips.chip.size() == 2);
    CHECK(bench.machine.lines.chips[1].outputs[0].safe_level); // the clamp
    bench.switches->act({.kind = EventKind::mist_on, .number = 0, .text = {}});
    CHECK(bench.levels(0) == (mist | flood_off));
    bench.switches->act({.kind = EventKind::flood_on, .number = 0, .text = {}});
    CHECK(bench.levels(0) == mist);
    bench.switches->act({.kind = EventKind::coolant_off, .number = 0, .text = {}});
    CHECK(bench.levels(0) == flood_off);
    bench.switches->act({.kind = EventKind::flood_on, .number = 0, .text = {}});
    bench.switches->act({.kind = EventKind::output_on_with_motion, .number = 7, .text = {}});
    CHECK(bench.levels(0) == door);
    bench.switches->act({.kind = EventKind::output_off_with_motion, .number = 7, .text = {}});
    CHECK(bench.levels(0) == 0);
    bench.switches->act({.kind = EventKind::output_on, .number = 7, .text = {}});
    bench.switches->act({.kind = EventKind::output_off, .number = 0, .text = {}});
    CHECK(bench.levels(0) == door);
    CHECK(bench.levels(1) == 0);
    bench.switches->end();
    CHECK(bench.levels(0) == flood_off);
    CHECK(bench.levels(1) == clamp);
    const std::size_t calls = bench.chips.chip[0]->rows().size();
    bench.switches->act({.kind = EventKind::mist_on, .number = 0, .text = {}});
    bench.switches->end();
    CHECK(bench.chips.chip[0]->rows().size() == calls);
    CHECK(bench.switches->trouble().empty());
}

TEST_CASE("A line that cannot be set is trouble that names it; the other chip becomes safe", "[switches]") {
    Bench bench;
    bench.switches->act({.kind = EventKind::output_off, .number = 0, .text = {}});
    bench.chips.chip[0]->fail_after(1);
    bench.switches->act({.kind = EventKind::flood_on, .number = 0, .text = {}});
    CHECK(bench.switches->trouble() == "/dev/gpiochip0 line 5 cannot be set: No such device");
    const std::size_t calls = bench.chips.chip[0]->rows().size();
    bench.switches->act({.kind = EventKind::mist_on, .number = 0, .text = {}});
    CHECK(bench.chips.chip[0]->rows().size() == calls);
    bench.switches->end();
    CHECK(bench.levels(0) == flood_off); // it was tried
    CHECK(bench.switches->unconfirmed() == "/dev/gpiochip0 MIST");
    CHECK(bench.levels(1) == clamp);
}
