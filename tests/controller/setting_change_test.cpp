// SPDX-License-Identifier: MIT
// What sets a `$` number: it reads back as it was written, and is no other.
#include "splinefeed/controller/setting_change.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"
#include "support/virtual_machine_tool.hpp"

#include <map>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

ControllerSettings settings_of_board() {
    ControllerSettings out = settings_of_machine_tool();
    out.home_switches = 7;
    return out;
}

std::map<std::int32_t, Decimal> all_of(const ControllerSettings& settings, const SenderSettings& sender) {
    std::map<std::int32_t, Decimal> out;
    for (std::int32_t number = 0; number < 1000; ++number) {
        Decimal value;
        if (SettingList(settings, sender, true).find(number, value)) {
            out[number] = value;
        }
    }
    return out;
}

std::string said(SettingFault fault, std::int32_t number) {
    std::array<char, 256> memory{};
    AnswerText out(memory);
    explain(fault, number, out);
    std::string text(out.size(), ' ');
    out.take(text);
    return text;
}

// Ranges of grbl's settings, for this test alone.
struct Row {
    std::int32_t number;
    double least;
    double most;
    bool is_whole;
};
constexpr Row rows[] = {
    {0, 1, 1000, true},       {1, 0, 255, true},        {2, 0, 7, true},          {3, 0, 7, true},
    {4, 0, 1, true},          {5, 0, 1, true},          {6, 0, 1, true},          {10, 0, 511, true},
    {13, 0, 1, true},         {20, 0, 1, true},         {21, 0, 1, true},         {22, 8, 9, true},
    {23, 0, 7, true},         {24, 0.01, 6e5, false},   {25, 0.01, 6e5, false},   {26, 0, 1000, true},
    {27, 0, 1000, false},     {30, 0, 1e6, false},      {31, 0, 1e6, false},      {100, 0.001, 1e6, false},
    {101, 0.001, 1e6, false}, {102, 0.001, 1e6, false}, {110, 0.06, 6e5, false},  {112, 0.06, 6e5, false},
    {120, 0.1, 1e6, false},   {122, 0.1, 1e6, false},   {130, 0.001, 1e6, false}, {132, 0.001, 1e6, false},
    {800, 0, 1e8, false},     {802, 0, 1e8, false},
};

} // namespace

TEST_CASE("a number that is set reads back, and all others stay", "[controller]") {
    std::mt19937_64 random(splinefeed_test::random_seed());
    ControllerSettings settings = settings_of_board();
    SenderSettings sender;
    for (int round = 0; round < splinefeed_test::rounds(2000); ++round) {
        const Row& row = rows[random() % std::size(rows)];
        const double share = static_cast<double>(random() % 1'000'001) / 1e6;
        const double skewed = row.least + (row.most - row.least) * (random() % 2 == 0 ? share : share * share * share);
        std::int64_t raw = static_cast<std::int64_t>(std::round(skewed * 1e9));
        raw = row.is_whole ? raw / Decimal::one * Decimal::one : raw;
        raw = random() % 20 == 0 ? static_cast<std::int64_t>(std::round(row.most * 1e9)) : raw;
        std::map<std::int32_t, Decimal> wanted = all_of(settings, sender);
        CAPTURE(row.number, raw);
        REQUIRE(wanted.count(row.number) == 1);
        REQUIRE(change_setting(row.number, {raw}, settings, sender) == SettingFault::none);
        std::map<std::int32_t, Decimal> found = all_of(settings, sender);
        // A double has 53 bits: all nine decimals below 4.5 million, the three that are shown up to 1e8.
        CHECK(std::abs(found[row.number].raw - raw) <= raw / 4'500'000'000'000'000 * 2);
        found.erase(row.number);
        wanted.erase(row.number);
        REQUIRE(found == wanted);
    }
}

TEST_CASE("numbers of grbl are those of the machine", "[controller]") {
    ControllerSettings settings = settings_of_board();
    SenderSettings sender;
    const auto set = [&](std::int32_t number, double value) {
        REQUIRE(change_setting(number, {static_cast<std::int64_t>(std::round(value * 1e9))}, settings, sender) ==
                SettingFault::none);
    };
    set(101, 400.5);
    CHECK(settings.machine.axis[1].steps_per_mm == 400.5);
    set(110, 600);
    set(111, 1500);
    set(112, 900);
    CHECK(settings.machine.axis[1].max_velocity_mm_s == 25.0);
    CHECK(settings.machine.max_feed_mm_s == 25.0); // the fastest axis
    CHECK(settings.max_feed_mm_s == Decimal::from_integer(25));
    set(122, 0.1);
    CHECK(settings.machine.axis[2].max_acceleration_mm_s2 == 0.1);
    set(800, 5000);
    CHECK(settings.machine.axis[0].max_jerk_mm_s3 == 5000.0);
    set(130, 450);
    set(132, 95.5);
    CHECK(settings.travel[0].low.raw == 0);
    CHECK(settings.travel[0].high == Decimal::from_integer(450));
    CHECK(settings.travel[2].low.raw == -95'500'000'000);
    CHECK(settings.travel[2].high.raw == 0);
    set(3, 5);
    CHECK(settings.wiring[0].invert_direction);
    CHECK_FALSE(settings.wiring[1].invert_direction);
    CHECK(settings.wiring[2].invert_direction);
    set(22, 0);
    CHECK(settings.homes == 0);
    set(22, 1);
    CHECK(settings.homes == 7);
    CHECK(settings.travel[0].high == Decimal::from_integer(450)); // where it is
    set(23, 1);
    CHECK(settings.wiring[0].homes_low);
    set(22, 9); // as grblHAL has it: where an axis homes is 0
    CHECK(settings.travel[0].low.raw == 0);
    CHECK(settings.travel[1].high.raw == 0);
    CHECK(settings.travel[1].low == Decimal::from_integer(-200));
    set(23, 2);
    CHECK(settings.travel[0].low == Decimal::from_integer(-450));
    CHECK(settings.travel[1].high == Decimal::from_integer(200));
    set(22, 1);
    CHECK(settings.travel[1].high.raw == 0);
    set(20, 0);
    CHECK_FALSE(settings.travel[1].limited);
    CHECK(settings.travel[1].low == Decimal::from_integer(-200));
    set(1, 100);
    CHECK(settings.idle_ms == 100);
}

TEST_CASE("the limit along the path is that of a rotary axis only where there is no other", "[controller]") {
    ControllerSettings settings = settings_of_board();
    settings.machine.axis[2].rotary = true;
    settings.machine.axis[2].max_velocity_mm_s = 1000.0;
    limit_path_by_axes(settings);
    CHECK(settings.machine.max_feed_mm_s == 100.0);
    settings.machine.axis[0].rotary = settings.machine.axis[1].rotary = true;
    limit_path_by_axes(settings);
    CHECK(settings.machine.max_feed_mm_s == 1000.0);
}

TEST_CASE("a number that is wrong is refused with what would be right", "[controller]") {
    ControllerSettings settings = settings_of_board();
    settings.home_switches = 0;
    SenderSettings sender;
    const auto [number, value, fault, sentence] = GENERATE(table<std::int32_t, double, SettingFault, std::string>({
        {0, 0, SettingFault::out_of_range, "[MSG:$0 is a whole number from 1 to 1000]\r\n"},
        {1, 256, SettingFault::out_of_range, "[MSG:$1 is a whole number from 0 to 255]\r\n"},
        {1, 0.5, SettingFault::out_of_range, "[MSG:$1 is a whole number from 0 to 255]\r\n"},
        {3, 8, SettingFault::absent, "[MSG:$3: the machine has nothing for it; it stays as it is]\r\n"},
        {11, 0.02, SettingFault::fixed, "[MSG:$11 is fixed]\r\n"},
        {22, 1, SettingFault::absent, "[MSG:$22: the machine has nothing for it; it stays as it is]\r\n"},
        {24, 0, SettingFault::out_of_range, "[MSG:$24 is a number from 0.010 to 600000]\r\n"},
        {27, -1, SettingFault::out_of_range, "[MSG:$27 is a number from 0 to 1000]\r\n"},
        {102, 0.0009, SettingFault::out_of_range, "[MSG:$102 is a number from 0.001 to 1000000]\r\n"},
        {103, 1, SettingFault::unknown, "[MSG:$103 is not known]\r\n"},
        {110, 600000.001, SettingFault::out_of_range, "[MSG:$110 is a number from 0.060 to 600000]\r\n"},
        {130, 0, SettingFault::out_of_range, "[MSG:$130 is a number from 0.001 to 1000000]\r\n"},
        {140, 1, SettingFault::unknown, "[MSG:$140 is not known]\r\n"},
        {801, -0.001, SettingFault::out_of_range, "[MSG:$801 is a number from 0 to 100000000]\r\n"},
    }));
    CAPTURE(number, value);
    const Decimal decimal{static_cast<std::int64_t>(std::round(value * 1e9))};
    CHECK(change_setting(number, decimal, settings, sender) == fault);
    CHECK(said(fault, number) == sentence);
}

TEST_CASE("every number that may be kept is one of the list, and none comes twice", "[controller]") {
    std::map<std::int32_t, int> seen;
    for (std::size_t i = 0; i < most_kept_settings; ++i) {
        ++seen[kept_setting(i)];
    }
    CHECK(seen.size() == most_kept_settings);
    for (const Row& row : rows) {
        CHECK(seen.count(row.number) == 1);
    }
    CHECK(seen.rbegin()->first == 805);
}
