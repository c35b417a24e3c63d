// SPDX-License-Identifier: MIT
#include "host_sim/config/profile_file.hpp"

#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

namespace {

const std::string good = "name = 'maker-1'\n"                                                                  // 1
                         "drive = 'Maker 1'\n"                                                                 // 2
                         "sources = ['a manual']\n"                                                            // 3
                         "not_verified = ['all of it']\n"                                                      // 4
                         "stream = 'blocks'\n"                                                                 // 5
                         "axes = 1\n"                                                                          // 6
                         "states = 'masks'\n"                                                                  // 7
                         "[link]\n"                                                                            // 8
                         "wires = ['rtu', 'tcp']\n"                                                            // 9
                         "unit = 7\n"                                                                          // 10
                         "baud = 57600\n"                                                                      // 11
                         "parity = 'O'\n"                                                                      // 12
                         "stop_bits = 2\n"                                                                     // 13
                         "silence_before_ms = 10\n"                                                            // 14
                         "silence_after_ms = 10.5\n"                                                           // 15
                         "turnaround_ms = 2\n"                                                                 // 16
                         "response_timeout_ms = 80\n"                                                          // 17
                         "retries = 5\n"                                                                       // 18
                         "functions = [3, 16]\n"                                                               // 19
                         "most_read_registers = 20\n"                                                          // 20
                         "most_write_registers = 10\n"                                                         // 21
                         "address_base = 1\n"                                                                  // 22
                         "reads_zero_until_written = true\n"                                                   // 23
                         "exchange_ms = [[9600, 24.9]]\n"                                                      // 24
                         "[[field]]\n"                                                                         // 25
                         "role = 'status'\n"                                                                   // 26
                         "address = 1\n"                                                                       // 27
                         "access = 'read'\n"                                                                   // 28
                         "[[field]]\n"                                                                         // 29
                         "role = 'target_position'\n"                                                          // 30
                         "address = 11\n"                                                                      // 31
                         "width = 32\n"                                                                        // 32
                         "signed = true\n"                                                                     // 33
                         "word_order = 'low_first'\n"                                                          // 34
                         "byte_order = 'low_first'\n"                                                          // 35
                         "scale = [-10, 3]\n"                                                                  // 36
                         "unit = 'counts'\n"                                                                   // 37
                         "clamp = [-1000, 1000]\n"                                                             // 38
                         "value = 3\n"                                                                         // 39
                         "[[field]]\n"                                                                         // 40
                         "role = 'profile_velocity'\n"                                                         // 41
                         "address = 13\n"                                                                      // 42
                         "inverse = true\n"                                                                    // 43
                         "[[field]]\n"                                                                         // 44
                         "role = 'actual_position'\n"                                                          // 45
                         "address = 2\n"                                                                       // 46
                         "[[field]]\n"                                                                         // 47
                         "name = 'gain'\n"                                                                     // 48
                         "address = 30\n"                                                                      // 49
                         "flash = true\n"                                                                      // 50
                         "[[field]]\n"                                                                         // 51
                         "role = 'mode'\n"                                                                     // 52
                         "address = 40\n"                                                                      // 53
                         "[[field]]\n"                                                                         // 54
                         "role = 'watchdog'\n"                                                                 // 55
                         "address = 41\n"                                                                      // 56
                         "[[field]]\n"                                                                         // 57
                         "role = 'following_error_window'\n"                                                   // 58
                         "address = 42\n"                                                                      // 59
                         "[[group]]\n"                                                                         // 60
                         "use = 'target'\n"                                                                    // 61
                         "fields = ['target_position', 'profile_velocity']\n"                                  // 62
                         "[[state]]\n"                                                                         // 63
                         "name = 'fault'\n"                                                                    // 64
                         "field = 'status'\n"                                                                  // 65
                         "mask = 0x0011\n"                                                                     // 66
                         "value = 0x0001\n"                                                                    // 67
                         "[[command]]\n"                                                                       // 68
                         "name = 'enable'\n"                                                                   // 69
                         "steps = [{field = 'mode', mask = 7, value = 5, kind = 'pulse', duration_ms = 20}]\n" // 70
                         "[[command]]\n"                                                                       // 71
                         "name = 'disable'\n"                                                                  // 72
                         "steps = [{field = 'mode', value = 0}]\n"                                             // 73
                         "[[command]]\n"                                                                       // 74
                         "name = 'fault_reset'\n"                                                              // 75
                         "steps = [{field = 'mode', mask = 8, kind = 'toggle'}]\n"                             // 76
                         "[[command]]\n"                                                                       // 77
                         "name = 'quick_stop'\n"                                                               // 78
                         "steps = [{field = 'mode', value = 9, kind = 'edge'}]\n"                              // 79
                         "[[command]]\n"                                                                       // 80
                         "name = 'start_move'\n"                                                               // 81
                         "steps = [{field = 'profile_velocity', value = 1}]\n"                                 // 82
                         "[motion]\n"                                                                          // 83
                         "stream_mode = 8\n"                                                                   // 84
                         "homing_mode = 6\n"                                                                   // 85
                         "change_on_the_fly = true\n"                                                          // 86
                         "period_ms = 2.5\n"                                                                   // 87
                         "done = {field = 'status', mask = 4, value = 4}\n"                                    // 88
                         "homed = {field = 'status', mask = 2, value = 0}\n"                                   // 89
                         "following_error_window_counts = 500\n"                                               // 90
                         "[watchdog]\n"                                                                        // 91
                         "timeout_ms = 100\n"                                                                  // 92
                         "reaction = 'quick_stop'\n"                                                           // 93
                         "[[init]]\n"                                                                          // 94
                         "field = 'gain'\n"                                                                    // 95
                         "value = 200\n"                                                                       // 96
                         "[[identity]]\n"                                                                      // 97
                         "field = 'status'\n"                                                                  // 98
                         "mask = 0x8000\n"                                                                     // 99
                         "value = 0\n"                                                                         // 100
                         "sentence = 'this is another drive'\n";                                               // 101

std::string with(const std::string& old_text, const std::string& new_text) {
    std::string text = good;
    const std::size_t at = text.find(old_text);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old_text.size(), new_text);
}

std::string without(const std::string& line) {
    return with(line, "");
}

} // namespace

TEST_CASE("A drive profile is read") {
    const DriveProfile profile = parse_profile(good, "p.toml");
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
    CHECK(profile.link.function_read);
    CHECK_FALSE(profile.link.function_write_one);
    CHECK(profile.link.function_write);
    CHECK_FALSE(profile.link.function_exchange);
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
}

TEST_CASE("What a profile may leave out") {
    const DriveProfile profile = parse_profile(without("baud = 57600\n"), "p.toml");
    CHECK(profile.link.baud == 19200);
    const RegisterField& status = profile.fields[0];
    CHECK(status.width_bits == 16);
    CHECK(status.lowest == 0);
    CHECK(status.highest == 65535);
    const std::string pvt =
        "name='p'\ndrive='d'\nsources=['s']\nnot_verified=[]\nstream='pvt'\naxes=6\n[link]\n"
        "wires=['tcp']\nunit=255\nfunctions=[3,16]\n[[field]]\nrole='status'\naddress=0\nwidth=64\n";
    CHECK(parse_profile(pvt, "p.toml").axes == 6);
    CHECK(parse_profile(pvt, "p.toml").link.unit == 255);
    CHECK_FALSE(parse_profile(pvt, "p.toml").following_error_window_counts.has_value());
    CHECK(parse_profile(pvt, "p.toml").fields[0].highest == std::numeric_limits<std::int64_t>::max());
}
