// SPDX-License-Identifier: MIT
#include "host_sim/config/profile_file.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

TEST_CASE("A drive profile is read") {
    // Every table and key of a profile.
    const DriveProfile profile = read_profile_file(splinefeed::test::source_folder() + "/tests/schemas/profile.toml");
    CHECK(profile.name == "maker-1");
    CHECK(profile.sources == std::vector<std::string>{"a manual"});
    CHECK(profile.stream == StreamWay::blocks);
    CHECK(profile.link.rtu);
    CHECK(profile.link.tcp);
    CHECK(profile.link.unit == 7);
    CHECK(profile.link.baud == 57600);
    CHECK(profile.link.parity == 'O');
    CHECK(profile.link.stop_bits == 2);
    CHECK(profile.link.silence_before_us == 10000);
    CHECK(profile.link.silence_after_us == 10500);
    CHECK(profile.link.turnaround_us == 2000);
    CHECK(profile.link.response_timeout_us == 80000);
    CHECK(profile.link.retries == 5);
    CHECK(profile.link.has(3));
    CHECK_FALSE(profile.link.has(6));
    CHECK(profile.link.has(16));
    CHECK_FALSE(profile.link.has(23));
    CHECK(profile.link.most_read_registers == 20);
    CHECK(profile.link.most_write_registers == 10);
    CHECK(profile.link.reads_zero_until_written);
    CHECK(profile.link.exchanges.front().baud == 9600);
    CHECK(profile.link.exchanges.front().duration_us == 24900);

    const RegisterField& target = profile.fields[1];
    CHECK(target.name == "target_position");
    CHECK(target.address == 10); // from 0
    CHECK(target.width_bits == 32);
    CHECK(target.is_signed);
    CHECK(target.word_order == Significance::low_first);
    CHECK(target.byte_order == Significance::low_first);
    CHECK(target.scale_numerator == -10);
    CHECK(target.scale_denominator == 3);
    CHECK(target.lowest == -1000);
    CHECK(target.highest == 1000);
    CHECK(target.value == 3);
    CHECK(target.unit == PhysicalUnit::counts);
    CHECK(profile.fields[2].inverse);
    CHECK(profile.fields[0].access == FieldAccess::read);
    CHECK(profile.fields[4].flash);

    CHECK(profile.groups.front().address == 10);
    CHECK(profile.groups.front().registers == 3);
    CHECK(profile.states.front().state == DriveState::fault);
    CHECK(profile.states.front().test.mask == 0x11);
    const CommandStep& pulse = profile.steps_of(DriveCommand::enable).front();
    CHECK(pulse.kind == StepKind::pulse);
    CHECK(pulse.mask == 7);
    CHECK(pulse.value == 5);
    CHECK(pulse.duration_ms == 20);
    CHECK(profile.steps_of(DriveCommand::disable).front().mask == 0xFFFF);
    CHECK(profile.stream_mode == 8);
    CHECK(profile.homing_mode == 6);
    CHECK(profile.change_on_the_fly);
    CHECK(profile.period_us == 2500);
    CHECK(profile.done->mask == 4);
    CHECK(profile.homed->value == 0);
    CHECK(profile.following_error_window_counts == 500);
    CHECK(profile.watchdog_timeout_ms == 100);
    CHECK(profile.watchdog_reaction == WatchdogReaction::quick_stop);
    CHECK(profile.init.front().value == 200);
    CHECK(profile.identity.front().sentence == "this is another drive");
    CHECK(profile.stays_on.front().sentence == "an input keeps it on");
    CHECK(profile.stays_on.front().test.mask == 0x4000);
}

TEST_CASE("What a profile may leave out") {
    const DriveProfile profile =
        parse_profile("name='p'\ndrive='d'\nsources=['s']\nnot_verified=[]\nstream='pvt'\naxes=6\n[link]\n"
                      "wires=['tcp']\nunit=255\nfunctions=[3,16]\n[[field]]\nrole='status'\naddress=0\n"
                      "[[field]]\nname='wide'\naddress=1\nwidth=64\n",
                      "p.toml");
    CHECK(profile.axes == 6);
    CHECK(profile.link.unit == 255);
    CHECK(profile.link.baud == 19200);
    CHECK_FALSE(profile.following_error_window_counts.has_value());
    CHECK(profile.fields[0].width_bits == 16);
    CHECK(profile.fields[0].lowest == 0);
    CHECK(profile.fields[0].highest == 65535);
    CHECK(profile.fields[1].highest == std::numeric_limits<std::int64_t>::max());
}
