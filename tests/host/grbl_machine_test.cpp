// SPDX-License-Identifier: MIT
#include "host_sim/serve/grbl_machine.hpp"

#include "host_sim/config/machine_file.hpp"
#include "host_sim/run/run_machine.hpp"
#include "host_sim/serve/serve_settings.hpp"

#include "splinefeed/controller/setting_list.hpp"

#include "support/catch.hpp"

#include <fmt/format.h>
#include <map>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// As grbl 1.1 answers.
const std::map<int, std::string> numbers{
    {0, "10"},        {1, "255"},        {2, "4"},         {3, "5"},         {4, "0"},         {5, "0"},
    {6, "0"},         {10, "1"},         {11, "0.010"},    {12, "0.002"},    {13, "0"},        {20, "1"},
    {21, "0"},        {22, "1"},         {23, "3"},        {24, "25.000"},   {25, "500.000"},  {26, "250"},
    {27, "1.000"},    {30, "24000"},     {31, "6000"},     {32, "0"},        {100, "250.000"}, {101, "80.000"},
    {102, "755.906"}, {110, "8000.000"}, {111, "500.000"}, {112, "635.001"}, {120, "500.000"}, {121, "10.000"},
    {122, "33.333"},  {130, "780.000"},  {131, "790.500"}, {132, "150.000"},
};

const std::string machine_text = R"(# Made of an answer to $$ by splinefeed machine --from-grbl.
name = "router"
sample_period_us = 1000
drives_at_end = "on"                 # $1=255

[path]
max_feed_mm_s = 133.333333

[step]
step_length_us = 10                  # $0=10

[spindle]
max_rpm = 24000                      # $30=24000
min_rpm = 6000                       # $31=6000

[[axis]]
name = "x"
steps_per_mm = 250                   # $100=250.000
max_velocity_mm_s = 133.333333       # $110=8000.000
max_acceleration_mm_s2 = 500         # $120=500.000
travel_mm = [-780, 0]                # $130=780.000
invert = true                        # $3=5

[[axis]]
name = "y"
steps_per_mm = 80                    # $101=80.000
max_velocity_mm_s = 8.333333         # $111=500.000
max_acceleration_mm_s2 = 10          # $121=10.000
travel_mm = [-790.5, 0]              # $131=790.500

[[axis]]
name = "z"
steps_per_mm = 755.906               # $102=755.906
max_velocity_mm_s = 10.58335         # $112=635.001
max_acceleration_mm_s2 = 33.333      # $122=33.333
travel_mm = [-150, 0]                # $132=150.000
invert_step = true                   # $2=4
invert = true                        # $3=5

# What a machine file does not say. [home.x] and inputs are of the map file of GPIO lines.
# $4=0             active of the line enable
# $5=0             active of the limit switches
# $6=0             active of the probe
# $10=1            senders set what a status has
# $11=0.010        corners are rounded within default_tolerance_mm of [path], or within the P of G64
# $12=0.002        arcs stay arcs
# $13=0            senders set inches
# $21=0            the limit switches
# $22=1            [home.x]
# $23=3            towards of [home.x]
# $24=25.000       latch_mm_s = 0.416667 of [home.x]
# $25=500.000      seek_mm_s = 8.333333 of [home.x]
# $26=250          debounce_us = 250000
# $27=1.000        pull_off_mm = 1 of [home.x]
# $32=0            there is no laser mode
)";

std::string listing(const char* format) {
    std::string out;
    for (const auto& [number, value] : numbers) {
        out += fmt::format(fmt::runtime(format), number, value);
    }
    return out;
}

} // namespace

TEST_CASE("A listing of $$ becomes a machine file, as terminals and senders save it") {
    for (const char* const format :
         {"${}={}\n", "${}={} (rapid, mm/min)\n", "${} = {}; a note\n", ">>> ok\n16:28:30.437 -> ${}={}\t[mm/sec^2]\n",
          " | ${}={} (z-axis, mask:00000100)\n[MSG: $x=3]\n", "${0}={1}\n<Idle|MPos:0,0,0>\n${0}={1}\nok\n"}) {
        CAPTURE(format);
        const GrblMachine machine = machine_of_grbl(listing(format), "some/router.txt");
        CHECK(machine.text == machine_text);
        CHECK(machine.left_out == 15);
    }
}

TEST_CASE("serve answers to $$ with the numbers of the listing") {
    const RunMachine machine(parse_machine(machine_text, "router.toml"), true);
    const SwitchFacts switches;
    const ControllerSettings settings = serve_settings(machine, switches);
    const SenderSettings sender;
    int known = 0;
    for (const auto& [number, value] : numbers) {
        if (number >= 100 || (number >= 1 && number <= 3) || number == 20 || number == 30 || number == 31) {
            CAPTURE(number);
            Decimal answer;
            REQUIRE(SettingList(settings, sender).find(number, answer));
            CHECK(static_cast<double>(answer.raw) * 1e-9 == Approx(std::stod(value)).margin(0.0005));
            ++known;
        }
    }
    CHECK(known == 18);
}

TEST_CASE("Axes that turn, machines without limits and numbers that are not known") {
    const GrblMachine machine =
        machine_of_grbl("$1=25\n$20=0\n$22=9\n$23=1\n$30=0\n$70=hello\n"
                        "$100=1\n$110=60\n$120=1\n$130=9\n$103=8.889\n$113=7200\n$123=720\n$133=0\n",
                        "-");
    CHECK(machine.text == R"(# Made of an answer to $$ by splinefeed machine --from-grbl.
name = "machine"
sample_period_us = 1000
drives_at_end = "off"                # $1=25

[path]
max_feed_mm_s = 1

[[axis]]
name = "x"
steps_per_mm = 1                     # $100=1
max_velocity_mm_s = 1                # $110=60
max_acceleration_mm_s2 = 1           # $120=1
# without soft limits, $20=0: travel_mm = [0, 9]                   # $130=9

[[axis]]
name = "a"
kind = "rotary"                      # degrees where the keys say mm
steps_per_mm = 8.889                 # $103=8.889
max_velocity_mm_s = 120              # $113=7200
max_acceleration_mm_s2 = 720         # $123=720

# What a machine file does not say. [home.x] and inputs are of the map file of GPIO lines.
# $22=9            [home.x]
# $23=1            towards of [home.x]
# $70=hello        not known here
)");
    CHECK(machine_problems(machine.text, "m").empty());
}
