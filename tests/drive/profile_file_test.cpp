// SPDX-License-Identifier: MIT
#include "host_sim/config/profile_file.hpp"

#include "host/refusal.hpp"
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

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(parse_profile(text, "p.toml")); });
}

struct Case {
    std::string text;
    std::string start;
    std::string part;
};

void check_refusals(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        const std::string told = refusal(c.text);
        CAPTURE(c.start, c.part, told);
        CHECK(told.compare(0, c.start.size(), c.start) == 0);
        CHECK(told.find(c.part) != std::string::npos);
        CHECK(told.find('\n') == std::string::npos);
    }
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

TEST_CASE("Profile: malformed heads and links are refused with their line") {
    check_refusals({
        {"", "p.toml:1: ", "has no name"},
        {"x = \n", "p.toml:1: ", ""},
        {"[\x07]\n", "p.toml:1: ", "name of a table"},
        {with("'maker-1'", "'Maker 1'"), "p.toml:1: ", "small letters"},
        {with("'maker-1'", "7"), "p.toml:1: ", "text"},
        {with("'maker-1'", "''"), "p.toml:1: ", "not empty"},
        {with("drive = ", "drvie = "), "p.toml:2: ", "did you mean 'drive'"},
        {without("drive = 'Maker 1'\n"), "p.toml", "has no drive"},
        {with("['a manual']", "[]"), "p.toml:3: ", "one at least"},
        {with("['a manual']", "'a manual'"), "p.toml:3: ", "list of texts"},
        {with("['a manual']", "[1]"), "p.toml:3: ", "text in quotes"},
        {without("not_verified = ['all of it']\n"), "p.toml", "has no not_verified"},
        {with("stream = 'blocks'", "stream = 'block'"), "p.toml:5: ", "did you mean 'blocks'"},
        {with("axes = 1", "axes = 7"), "p.toml:6: ", "1 to 6"},
        {with("axes = 1", "axes = 2"), "p.toml:6: ", "pvt"},
        {with("'masks'", "'mask'"), "p.toml:7: ", "did you mean 'masks'"},
        {with("[link]", "[lnik]"), "p.toml:8: ", "did you mean 'link'"},
        {with("'rtu', 'tcp'", "'rtu', 'udp'"), "p.toml:9: ", "'udp'"},
        {with("['rtu', 'tcp']", "[]"), "p.toml:9: ", "both"},
        {with("unit = 7", "unit = 256"), "p.toml:10: ", "1 to 247"},
        {with("unit = 7", "unit = 0"), "p.toml:10: ", "1 to 247"},
        {with("unit = 7", "unit = 250"), "p.toml:10: ", "1 to 247"},
        {with("['rtu', 'tcp']\nunit = 7", "['rtu']\nunit = 255"), "p.toml:10: ", "1 to 247"},
        {with("unit = 7", "units = 7"), "p.toml:10: ", "did you mean 'unit'"},
        {with("57600", "0"), "p.toml:11: ", "1200 to 4000000"},
        {with("'O'", "'odd'"), "p.toml:12: ", "known are N, E, O"},
        {with("stop_bits = 2", "stop_bits = 3"), "p.toml:13: ", "1 to 2"},
        {with("silence_before_ms = 10", "silence_before_ms = -1"), "p.toml:14: ", "0 to 1000 ms"},
        {with("= 10.5", "= 'long'"), "p.toml:15: ", "0 to 1000 ms"},
        {with("turnaround_ms = 2", "turnaround_ms = nan"), "p.toml:16: ", "0 to 1000 ms"},
        {with("timeout_ms = 80", "timeout_ms = 0"), "p.toml:17: ", "more than 0"},
        {with("retries = 5", "retries = 1.5"), "p.toml:18: ", "whole number"},
        {with("[3, 16]", "[3, 4]"), "p.toml:19: ", "3, 6, 16 and 23"},
        {with("[3, 16]", "[3]"), "p.toml:19: ", "6 or 16, which write"},
        {with("[3, 16]", "[16]"), "p.toml:19: ", "3, which reads"},
        {with("[3, 16]", "[3, 23]"), "p.toml:19: ", "6 or 16, which write"},
        {with("[3, 16]", "[3, 6]"), "p.toml:29: ", "field 'target_position' has 2 registers, which function 16 alone"},
        {with("registers = 20", "registers = 1"), "p.toml:29: ", "by [link] the drive sends at most 1 in a frame"},
        {with("registers = 10", "registers = 1"), "p.toml:29: ", "by [link] the drive takes at most 1 in a frame"},
        {with("registers = 20", "registers = 126"), "p.toml:20: ", "1 to 125"},
        {with("registers = 10", "registers = 124"), "p.toml:21: ", "1 to 123"},
        {with("base = 1", "base = 2"), "p.toml:22: ", "0 to 1"},
        {with("= true\nexchange", "= 1\nexchange"), "p.toml:23: ", "true or false"},
        {with("[[9600, 24.9]]", "[9600, 24.9]"), "p.toml:24: ", "pairs"},
        {with("[[9600, 24.9]]", "[[96, 24.9]]"), "p.toml:24: ", "1200"},
        {with("[[9600, 24.9]]", "[[9600, -2]]"), "p.toml:24: ", "time of an exchange"},
    });
}

TEST_CASE("Profile: malformed fields and groups are refused with their line") {
    check_refusals({
        {with("role = 'status'", "role = 'statuss'"), "p.toml:26: ", "did you mean 'status'"},
        {with("role = 'status'", "role = 'none'"), "p.toml:26: ", "did you mean"},
        {with("role = 'status'\n", ""), "p.toml:25: ", "a role or"},
        {with("role = 'status'", "name = 'status'"), "p.toml:26: ", "write role"},
        {with("name = 'gain'", "name = 'gain'\nrole = 'control'"), "p.toml:47: ", "a role or"},
        {with("role = 'actual_position'", "role = 'status'"), "p.toml:45: ", "two fields 'status'"},
        {with("address = 1\n", "address = 0\n"), "p.toml:27: ", "1 to 65536"},
        {with("address = 1\n", ""), "p.toml:25: ", "has no address"},
        {with("address = 11", "address = 65536"), "p.toml:31: ", "1 to 65535"},
        {with("'read'\n", "'none'\n"), "p.toml:28: ", "'none'"},
        {with("width = 32", "width = 24"), "p.toml:32: ", "16, 32 or 64"},
        {with("signed = true", "signed = 'yes'"), "p.toml:33: ", "true or false"},
        {with("word_order = 'low_first'", "word_order = 'low'"), "p.toml:34: ", "'low'"},
        {with("byte_order = 'low_first'", "byte_order = 1"), "p.toml:35: ", "text"},
        {with("[-10, 3]", "[1]"), "p.toml:36: ", "two whole numbers"},
        {with("[-10, 3]", "0.5"), "p.toml:36: ", "two whole numbers"},
        {with("[-10, 3]", "[0, 3]"), "p.toml:36: ", "is 0"},
        {with("[-10, 3]", "[1, 0]"), "p.toml:36: ", "second number"},
        {with("[-10, 3]", "[1, -3]"), "p.toml:36: ", "second number"},
        {with("unit = 'counts'", "unit = 'mm'"), "p.toml:37: ", "known are number"},
        {with("unit = 'counts'", "unit = 'ms'"), "p.toml:37: ", "must be \"counts\""},
        {with("[-1000, 1000]", "[1000, -1000]"), "p.toml:38: ", "below the first"},
        {with("[-1000, 1000]", "[-1000, 0x80000000]"), "p.toml:38: ", "2147483647"},
        {with("[-1000, 1000]", "[-1000]"), "p.toml:38: ", "lowest and the highest"},
        {with("value = 3\n", "value = 1001\n"), "p.toml:39: ", "-1000 to 1000"},
        {with("address = 13", "address = 12"), "p.toml:40: ", "share registers"},
        {with("inverse = true", "inverted = true"), "p.toml:43: ", "did you mean 'inverse'"},
        {with("flash = true", "flash = 2"), "p.toml:50: ", "true or false"},
        {with("use = 'target'", "use = 'targets'"), "p.toml:61: ", "did you mean 'target'"},
        {with("use = 'target'\n", ""), "p.toml:60: ", "has no use"},
        {with("['target_position', 'profile_velocity']", "['profile_velocity', 'target_position']"),
         "p.toml:62: ", "begins at 11, but the group goes on at 14"},
        {with("['target_position', 'profile_velocity']", "['status']"), "p.toml:62: ", "cannot be written"},
        {with("['target_position', 'profile_velocity']", "['gain']"), "p.toml:62: ", "flash"},
        {with("['target_position', 'profile_velocity']", "['gian']"), "p.toml:62: ", "did you mean 'gain'"},
        {with("['target_position', 'profile_velocity']", "[]"), "p.toml:62: ", "1 to 10"},
        {with("most_write_registers = 10", "most_write_registers = 2"), "p.toml:62: ", "3 registers"},
        {with("[[state]]", "[[group]]\nuse = 'target'\nfields = ['mode']\n[[state]]"), "p.toml:63: ", "two groups"},
        {with("[[field]]\nrole = 'status'", "[field]\nrole = 'status'"), "p.toml", ""},
    });
}

TEST_CASE("Profile: malformed states, commands, motion, watchdog, init and identity are refused with their line") {
    check_refusals({
        {with("name = 'fault'\n", "name = 'failed'\n"), "p.toml:64: ", "known are"},
        {with("field = 'status'\nmask = 0x0011", "field = 'stats'\nmask = 0x0011"), "p.toml:65: ", "did you mean"},
        {with("mask = 0x0011", "mask = 0"), "p.toml:66: ", "1 to 65535"},
        {with("mask = 0x0011", "mask = 0x10000"), "p.toml:66: ", "1 to 65535"},
        {with("value = 0x0001", "value = 0x0002"), "p.toml:67: ", "outside the mask"},
        {with("value = 0x0001\n", ""), "p.toml:63: ", "has no value"},
        {with("states = 'masks'", "states = 'cia402'"), "p.toml:63: ", "leave [[state]] out"},
        {with("name = 'enable'", "name = 'enabel'"), "p.toml:69: ", "did you mean 'enable'"},
        {with("name = 'disable'", "name = 'enable'"), "p.toml:72: ", "two commands"},
        {with("steps = [{field = 'mode', value = 0}]", "steps = []"), "p.toml:73: ", "no steps"},
        {with("steps = [{field = 'mode', value = 0}]", "steps = [0]"), "p.toml:73: ", "a step of disable"},
        {with("'mode', mask = 7", "'status', mask = 7"), "p.toml:70: ", "cannot be written"},
        {with("'mode', mask = 7", "'gain', mask = 7"), "p.toml:70: ", "flash"},
        {with("mask = 7, value = 5", "mask = 7, value = 9"), "p.toml:70: ", "outside the mask"},
        {with("mask = 7, value = 5", "mask = 7"), "p.toml:70: ", "has no value"},
        {with("kind = 'pulse'", "kind = 'puls'"), "p.toml:70: ", "did you mean 'pulse'"},
        {with(", duration_ms = 20", ""), "p.toml:70: ", "duration_ms of 1"},
        {with("duration_ms = 20", "duration_ms = 60001"), "p.toml:70: ", "0 to 60000"},
        {with("duration_ms = 20", "duration = 20"), "p.toml:70: ", "known are field, mask, value, kind, duration_ms"},
        {with("mask = 8, kind", "mask = 8, value = 8, kind"), "p.toml:76: ", "leave value out"},
        {with("stream_mode = 8", "stream_mode = -1"), "p.toml:84: ", "0 to 65535"},
        {with("role = 'mode'", "name = 'other'"), "p.toml", ""},
        {with("homing_mode = 6", "homing_mode = 'home'"), "p.toml:85: ", "whole number"},
        {with("change_on_the_fly = true", "change_on_fly = true"), "p.toml:86: ", "did you mean 'change_on_the_fly'"},
        {with("change_on_the_fly = true", "change_on_the_fly = false"), "p.toml: ", "change_on_the_fly"},
        {with("period_ms = 2.5", "period_ms = 1001"), "p.toml:87: ", "0 to 1000 ms"},
        {with("{field = 'status', mask = 4, value = 4}", "4"), "p.toml:88: ", "done must be like"},
        {with("mask = 2, value = 0", "mask = 2, valeu = 0"), "p.toml:89: ", "did you mean 'value'"},
        {with("window_counts = 500", "window_counts = 0"), "p.toml:90: ", "1 to"},
        {with("role = 'following_error_window'", "name = 'window'"), "p.toml:90: ", "role"},
        {with("role = 'watchdog'", "name = 'dog'"), "p.toml:92: ", "role"},
        {with("timeout_ms = 100", "timeout_ms = 0"), "p.toml:92: ", "1 to 60000"},
        {with("timeout_ms = 100", "timeout_ms = 100\nkeep_alive_ms = 30"),
         "p.toml:93: ", "unknown key 'keep_alive_ms'"},
        {with("timeout_ms = 100", "timeout_ms = 100\nstale_ms = 30"), "p.toml:93: ", "unknown key 'stale_ms'"},
        {with("reaction = 'quick_stop'", "reaction = 'slow'"), "p.toml:93: ", "did you mean 'stop'"},
        {with("field = 'gain'", "field = 'status'"), "p.toml:95: ", "cannot be written"},
        {with("value = 200", "value = 70000"), "p.toml:96: ", "0 to 65535"},
        {with("flash = true", "flash = true\naccess = 'write'"), "p.toml:95: ", "cannot be read"},
        {with("sentence = 'this is another drive'\n", ""), "p.toml:97: ", "has no sentence"},
        {with("mask = 0x8000\nvalue = 0", "mask = 0x8000\nvalue = 1"), "p.toml:100: ", "outside the mask"},
    });
}

TEST_CASE("Profile: what its way of streaming cannot do without") {
    check_refusals({
        {with("role = 'status'\naddress = 1\naccess = 'read'", "role = 'status'\naddress = 1\naccess = 'write'"),
         "p.toml:65: ", "cannot be read"},
        {with("role = 'actual_position'", "name = 'position'"), "p.toml: ", "role = \"actual_position\""},
        {with("name = 'disable'", "name = 'halt'"), "p.toml: ", "no command disable"},
        {with("name = 'start_move'", "name = 'resume'"), "p.toml: ", "start_move"},
        {"name='p'\ndrive='d'\nsources=['s']\nnot_verified=[]\nstream='pvt'\n[link]\nwires=['tcp']\nfunctions=[3, 6]\n"
         "[[field]]\nrole='status'\naddress=0\n",
         "p.toml: ", "needs function 16"},
    });
}
