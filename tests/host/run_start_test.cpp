// SPDX-License-Identifier: MIT
#include "host_sim/run/run_start.hpp"

#include "host_sim/config/machine_file.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

using Place = std::optional<double>;

/// Three axes of 320 counts/mm: a shaft that stands lies within 0.01 mm.
struct Case {
    const char* what;
    StartWay way = StartWay::check;
    bool home = false;
    std::array<Place, 2> stands;
    std::array<double, 2> begins;
    const char* refused = "accepted";  // part of the sentence
    std::array<Place, 2> moves_from{}; // nothing: no move
};

const Case cases[] = {
    {.what = "there", .stands = {17.4, 3.0}, .begins = {17.4, 3.0}},
    {.what = "within the window", .stands = {17.4, 3.0}, .begins = {17.409, 2.991}},
    {.what = "elsewhere",
     .stands = {17.4, 3.0},
     .begins = {20.0, 3.0},
     .refused = "the machine stands at x=17.4000 mm, and the program begins at x=20.0000 mm; add --start move, and it "
                "goes there in a straight line first, or --start here, if that is where it stands"},
    {.what = "both axes",
     .stands = {-1.0, 3.0},
     .begins = {20.0, 4.5},
     .refused = "stands at x=-1.0000 y=3.0000 mm, and the program begins at x=20.0000 y=4.5000 mm"},
    {.what = "elsewhere, and it moves",
     .way = StartWay::move,
     .stands = {17.4, 3.0},
     .begins = {20.0, 3.0},
     .moves_from = {17.4, 3.0}},
    {.what = "elsewhere, by the user's word", .way = StartWay::here, .stands = {17.4, 3.0}, .begins = {20.0, 3.0}},
    {.what = "one axis is not known", .stands = {17.4, {}}, .begins = {17.4, 99.0}},
    {.what = "the other one is elsewhere", .stands = {17.4, {}}, .begins = {0.0, 99.0}, .refused = "at x=17.4000 mm"},
    {.what = "a move from nowhere",
     .way = StartWay::move,
     .stands = {17.4, {}},
     .begins = {17.4, 99.0},
     .refused = "--start move: nobody knows where y stands; add --home, or --start here"},
    {.what = "behind homing", .home = true, .stands = {0.0, 0.0}, .begins = {5.0, 0.0}, .moves_from = {0.0, 0.0}},
};

std::vector<RunTarget::AxisPlace> standing(const Case& one) {
    return {{0, one.stands[0]}, {1, one.stands[1]}};
}

MachineDescription two_axes() {
    MachineDescription machine = default_machine();
    machine.settings.axes = 2;
    for (AxisSettings& axis : machine.settings.axis) {
        axis.steps_per_mm = 320.0;
    }
    return machine;
}

} // namespace

TEST_CASE("A run begins where the machine stands, moves there or is refused") {
    const MachineDescription machine = two_axes();
    for (const Case& one : cases) {
        INFO(one.what);
        const RunStart start(machine, {.orders = {.home = one.home}, .start = one.way}, standing(one));
        const PerAxis<double> begins{one.begins[0], one.begins[1]};
        std::optional<PerAxis<double>> from;
        const std::string sentence = splinefeed_test::refusal_of<UsageError>([&] { from = start.move_from(begins); });
        CHECK(sentence.find(one.refused) != std::string::npos);

        CHECK(from.has_value() == one.moves_from[0].has_value());
        for (std::size_t k = 0; from && k < 2; ++k) {
            CHECK((*from)[k] == one.moves_from[k]);
        }
    }
}

TEST_CASE("Axes of which nobody knows where they stand are named, unless the user says where") {
    const MachineDescription machine = two_axes();
    const Case one{.what = "", .stands = {17.4, {}}, .begins = {}};
    CHECK(RunStart(machine, {}, standing(one)).note().find("nobody knows where y stands") == 0);
    CHECK(RunStart(machine, {.start = StartWay::here}, standing(one)).note().empty());
    CHECK(RunStart(machine, {.orders = {.home = true}}, {}).note().empty()); // the target goes to the program by itself
    CHECK_FALSE(RunStart(machine, {.orders = {.home = true}}, {}).move_from({5.0, 0.0}));
}

TEST_CASE("A program in G-code begins where it is told, else where the drives stand") {
    const MachineDescription machine = two_axes();
    RunStart start(machine, {}, {{0, 17.4}, {1, {}}});
    PerAxis<Place> begins{};
    start.settle(begins);
    CHECK(begins[0] == 17.4);
    CHECK_FALSE(begins[1]);
    begins = {20.0, 7.0};
    start.settle(begins); // as a state file says; the drive of x says something else
    CHECK(begins[0] == 20.0);
    CHECK(start.note().empty()); // y is known by the file
    CHECK(splinefeed_test::refusal_of<UsageError>([&] {
              static_cast<void>(start.move_from({20.0, 7.0}));
          }).find("stands at x=17.4000 mm, and the program begins at x=20.0000 mm") != std::string::npos);
}
