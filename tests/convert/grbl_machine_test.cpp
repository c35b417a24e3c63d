// SPDX-License-Identifier: MIT
#include "host_sim/convert/grbl_machine.hpp"

#include "host_sim/config/machine_file.hpp"
#include "host_sim/run/run_machine.hpp"
#include "host_sim/serve/serve_settings.hpp"

#include "splinefeed/controller/setting_list.hpp"

#include "support/golden_text.hpp"

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

std::string listing(const char* format) {
    std::string out;
    for (const auto& [number, value] : numbers) {
        out += fmt::format(fmt::runtime(format), number, value);
    }
    return out;
}

} // namespace

TEST_CASE("Listings of $$ become the machine files of grbl_machines.txt, as terminals and senders save them") {
    const std::string usual = machine_text(grbl_sketch(listing("${}={}\n"), "some/router.txt"));
    for (const char* const format :
         {"${}={} (rapid, mm/min)\n", "${} = {}; a note\n", ">>> ok\n16:28:30.437 -> ${}={}\t[mm/sec^2]\n",
          " | ${}={} (z-axis, mask:00000100)\n[MSG: $x=3]\n", "${0}={1}\n<Idle|MPos:0,0,0>\n${0}={1}\nok\n"}) {
        CAPTURE(format);
        const MachineSketch machine = grbl_sketch(listing(format), "some/router.txt");
        CHECK(machine_text(machine) == usual);
        CHECK(machine.rest.size() == 15);
    }
    // Axes that turn, machines without limits and numbers that are not known.
    const std::string other =
        machine_text(grbl_sketch("$1=25\n$20=0\n$22=9\n$23=1\n$30=0\n$70=hello\n"
                                 "$100=1\n$110=60\n$120=1\n$130=9\n$103=8.889\n$113=7200\n$123=720\n$133=0\n",
                                 "-"));
    CHECK(machine_problems(other, "m").empty());
    splinefeed_test::require_golden("convert/grbl_machines.txt", usual + "\n" + other);
}

TEST_CASE("serve answers to $$ with the numbers of the listing") {
    const std::string text = machine_text(grbl_sketch(listing("${}={}\n"), "router.txt"));
    const RunMachine machine(parse_machine(text, "router.toml"), true);
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
