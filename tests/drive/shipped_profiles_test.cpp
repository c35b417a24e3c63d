// SPDX-License-Identifier: MIT
#include "host_sim/config/shipped_profiles.hpp"

#include "host/refusal.hpp"
#include "host_sim/base/input_error.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <set>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

TEST_CASE("Every shipped profile is read, has its file's name, and says what it was made from") {
    std::set<std::string> names;
    for (const ShippedProfile& shipped : shipped_profiles()) {
        CAPTURE(shipped.name);
        const DriveProfile profile = find_profile(std::string(shipped.name));
        CHECK(profile.name == shipped.name);
        CHECK_FALSE(profile.sources.empty());
        CHECK_FALSE(profile.not_verified.empty()); // none was on hardware yet
        names.insert(profile.name);
    }
    CHECK(names == std::set<std::string>{"cia402-index", "cia402-kinco", "leadshine-pr", "lexium32m", "oriental-az",
                                         "splinefeed-pvt", "vfd-delta-ms300", "vfd-gs2", "vfd-h100", "vfd-ls-ig5a",
                                         "vfd-omron-mx2", "vfd-optidrive", "vfd-yl620"});
}

TEST_CASE("The shipped profiles have what their makers' documents say") {
    const DriveProfile kinco = find_profile("cia402-kinco");
    CHECK(kinco.cia402);
    CHECK(kinco.field_of(FieldRole::status)->address == 0x3200);
    CHECK(kinco.field_of(FieldRole::mode)->address == 0x3500);
    CHECK(kinco.field_of(FieldRole::actual_position)->address == 0x3700);
    CHECK(kinco.field_of(FieldRole::target_position)->address == 0x4000);
    CHECK(kinco.field_of(FieldRole::target_position)->word_order == Significance::low_first);
    CHECK(kinco.field_of(FieldRole::profile_velocity)->address == 0x4A00);

    const DriveProfile index = find_profile("cia402-index");
    CHECK(index.stream == StreamWay::cyclic);
    CHECK(index.field_of(FieldRole::control)->address == 0x6040);
    CHECK(index.field_of(FieldRole::actual_position)->address == 0x6064);
    CHECK(index.link.unit == 255);
    CHECK_FALSE(index.link.rtu);

    const DriveProfile leadshine = find_profile("leadshine-pr");
    CHECK(leadshine.group_for(GroupUse::target)->address == 0x6200);
    CHECK(leadshine.group_for(GroupUse::target)->registers == 8);
    CHECK(leadshine.field_of(FieldRole::actual_position)->address == 0x602C);
    REQUIRE(leadshine.stays_on.size() == 1); // SI1 is enable, normally closed
    CHECK(leadshine.fields[leadshine.stays_on.front().test.field].address == 0x0145);
    CHECK(leadshine.stays_on.front().test.value == 0x0088);
    REQUIRE(leadshine.link.exchanges.size() == 4);
    CHECK(leadshine.link.exchanges[3].duration_us == 3080);

    const DriveProfile oriental = find_profile("oriental-az");
    CHECK(oriental.group_for(GroupUse::target)->address == 0x0058);
    CHECK(oriental.group_for(GroupUse::target)->registers == 16);
    CHECK(oriental.link.parity == 'E');
    CHECK(oriental.steps_of(DriveCommand::fault_reset).front().kind == StepKind::pulse);
    CHECK(oriental.steps_of(DriveCommand::fault_reset).front().duration_ms == 20);

    const DriveProfile lexium = find_profile("lexium32m");
    CHECK(lexium.group_for(GroupUse::target)->registers == 13);
    CHECK(lexium.group_for(GroupUse::status)->registers == 13);
    CHECK(lexium.link.reads_zero_until_written);
    CHECK(lexium.steps_of(DriveCommand::start_move).front().kind == StepKind::toggle);

    const DriveProfile delta = find_profile("vfd-delta-ms300");
    CHECK(delta.stream == StreamWay::speed);
    CHECK(delta.field_of(FieldRole::target_velocity)->address == 0x2001);
    CHECK(delta.field_of(FieldRole::actual_velocity)->address == 0x2103);
    CHECK(delta.steps_of(DriveCommand::forward).front().value == 0x12);

    const DriveProfile mx2 = find_profile("vfd-omron-mx2");
    CHECK(mx2.fields[mx2.index_of("run")].place() == place_in(RegisterTable::coils, 0)); // coil 1 of its manual
    CHECK(mx2.fields[mx2.index_of("alarm")].place() == place_in(RegisterTable::coils, 0x17));
    CHECK(mx2.field_of(FieldRole::actual_velocity)->address == 0x1000);

    const DriveProfile h100 = find_profile("vfd-h100");
    CHECK(h100.field_of(FieldRole::actual_velocity)->table == RegisterTable::input);
    CHECK(h100.fields[h100.steps_of(DriveCommand::stop).front().field].place() == place_in(RegisterTable::coils, 0x4B));

    const DriveProfile optidrive = find_profile("vfd-optidrive");
    CHECK(optidrive.field_of(FieldRole::control)->address == 0); // register 1 of its manual
    CHECK(optidrive.field_of(FieldRole::actual_velocity)->address == 6);
    CHECK(optidrive.steps_of(DriveCommand::reverse).empty());

    const DriveProfile pvt = find_profile("splinefeed-pvt");
    CHECK(pvt.axes == 6);
    CHECK(pvt.link.has(23));
    CHECK(pvt.identity.size() == 4);
}

TEST_CASE("No shipped profile writes flash where it writes again and again") {
    for (const ShippedProfile& shipped : shipped_profiles()) {
        const DriveProfile profile = find_profile(std::string(shipped.name));
        for (const FieldGroup& group : profile.groups) {
            for (const FieldIndex index : group.fields) {
                CHECK_FALSE((group.use == GroupUse::target && profile.fields[index].flash));
            }
        }
    }
}

TEST_CASE("A profile that is not there is refused with the nearest name") {
    const std::string told =
        splinefeed_test::refusal_of<UsageError>([] { static_cast<void>(find_profile("leadshine")); });
    CHECK(told == "there is no profile 'leadshine'; did you mean 'leadshine-pr'?");
    CHECK(splinefeed_test::refusal_of([] {
              static_cast<void>(find_profile("nowhere.toml"));
          }).rfind("nowhere.toml: cannot be opened", 0) == 0);
}

TEST_CASE("The list of profiles has a row for each") {
    const std::string list = list_profiles();
    CHECK(std::count(list.begin(), list.end(), '\n') == static_cast<std::ptrdiff_t>(shipped_profiles().size()) + 1);
    CHECK(list.find("leadshine-pr    blocks on the fly   rtu       Leadshine CS2RS, iEM-RS, DM-RS\n") !=
          std::string::npos);
}

TEST_CASE("States of a CiA 402 status word") {
    CHECK(cia402_state(0x0000) == DriveState::not_ready);
    CHECK(cia402_state(0x0240) == DriveState::disabled);
    CHECK(cia402_state(0x0231) == DriveState::disabled);
    CHECK(cia402_state(0x0233) == DriveState::disabled);
    CHECK(cia402_state(0x0637) == DriveState::enabled);
    CHECK(cia402_state(0x0217) == DriveState::quick_stop);
    CHECK(cia402_state(0x0218) == DriveState::fault);
    CHECK(cia402_state(0x021F) == DriveState::fault);
}
