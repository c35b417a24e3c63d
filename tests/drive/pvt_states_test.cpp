// SPDX-License-Identifier: MIT
// Every command in every state; sessions, counters, and what is not on the path.
#include "pvt_bench.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

namespace {

std::unique_ptr<PvtBench> bench_in(PvtState state) {
    PvtDriveParameters parameters;
    parameters.axes.front().start_counts = 1000.0;
    auto bench = std::make_unique<PvtBench>(2, parameters);
    if (state == PvtState::disabled) {
        return bench;
    }
    bench->begin();
    if (state == PvtState::standing) {
        return bench;
    }
    if (state == PvtState::homing) {
        static_cast<void>(bench->command(PvtCommand::home));
        bench->wait_us(1000);
        return bench;
    }
    // From where it stands, some acceleration and then steadily on.
    auto segments = steady(2, 7, 400000, 1000.0);
    for (PvtSegment& segment : segments) {
        segment.end[0] += 1000 << 16;
        segment.end[1] += 1000 << 16;
    }
    static_cast<void>(bench->feed(0, std::vector<PvtSegment>(segments.begin(), segments.begin() + 4)));
    static_cast<void>(bench->feed(4, std::vector<PvtSegment>(segments.begin() + 4, segments.end())));
    bench->start_now();
    bench->wait_us(15000);
    if (state == PvtState::running) {
        return bench;
    }
    if (state == PvtState::fault) {
        static_cast<void>(bench->drive.write(0x0012, std::array<std::uint16_t, 2>{0, 1})); // the window
        bench->drive.machine().shaft(0).disturb(1e7);
        bench->wait_us(100000);
        return bench;
    }
    static_cast<void>(bench->command(PvtCommand::hold, bench->status().clock_us));
    bench->wait_us(state == PvtState::stopping ? 1000 : 1'000'000);
    return bench;
}

struct Answer {
    PvtRefusal refusal = PvtRefusal::none;
    PvtState state = PvtState::disabled; ///< when the command was taken
};

constexpr auto no = PvtRefusal::state;
constexpr auto session = PvtRefusal::session;

} // namespace

TEST_CASE("PVT drive: every command in every state", "[drive][pvt]") {
    using S = PvtState;
    const auto yes = [](S state) {
        return Answer{PvtRefusal::none, state};
    };
    const Answer n{no, {}};
    const Answer s{session, {}};
    const auto d = yes(S::disabled);
    const auto i = yes(S::standing);
    const auto r = yes(S::running);
    const auto t = yes(S::stopping);
    const auto h = yes(S::held);
    const auto f = yes(S::fault);
    // In the order of the numbers of states: disabled, standing, running, stopping, held, fault, homing.
    const std::vector<std::pair<PvtCommand, std::array<Answer, 7>>> table{
        {PvtCommand::enable, {i, i, n, n, n, n, n}},
        {PvtCommand::disable, {d, d, n, n, d, n, n}},
        {PvtCommand::begin, {n, i, n, n, i, n, n}},
        {PvtCommand::start, {s, h, n, n, n, s, n}}, // the ring is empty: it ends at once
        {PvtCommand::hold, {s, n, t, t, h, s, n}},
        {PvtCommand::resume, {s, n, n, n, r, s, n}},
        {PvtCommand::quick_stop, {d, i, t, t, i, f, t}},
        {PvtCommand::end, {s, n, r, t, h, s, n}},
        {PvtCommand::fault_reset, {d, n, n, n, n, d, n}},
        {PvtCommand::home, {s, yes(S::homing), n, n, n, s, n}},
        {PvtCommand::preset_position, {s, i, n, n, n, s, n}},
        {static_cast<PvtCommand>(12), {s, n, n, n, n, s, n}},
        {static_cast<PvtCommand>(65535), {s, n, n, n, n, s, n}},
    };
    for (const auto& [command, answers] : table) {
        for (std::uint16_t state = 0; state < 7; ++state) {
            CAPTURE(static_cast<int>(command), state);
            const auto bench = bench_in(static_cast<S>(state));
            const PvtStatus before = bench->status();
            REQUIRE(before.state == static_cast<S>(state));
            const Answer& expected = answers[state];
            const std::vector<PvtSegment> place(command == PvtCommand::preset_position ? 1 : 0);
            const PvtStatus after = bench->command(command, before.clock_us, place);
            CHECK(after.refused == expected.refusal);
            CHECK(after.state == (expected.refusal == PvtRefusal::none ? expected.state : before.state));
            CHECK(after.last_command == (expected.refusal == PvtRefusal::none ? bench->counter : before.last_command));
            CHECK(after.refusals == before.refusals + (expected.refusal == PvtRefusal::none ? 0 : 1));
            const bool loses = after.refused == PvtRefusal::none &&
                               (command == PvtCommand::disable || command == PvtCommand::quick_stop);
            if (loses) {
                CHECK(after.next == after.executed);
                CHECK(bench->feed(after.next, steady(2, 1, 8000, 1.0)).refused == session);
            }
        }
    }
}

TEST_CASE("PVT drive: segments are taken in states 1 to 4 only", "[drive][pvt]") {
    for (const PvtState state : {PvtState::standing, PvtState::running, PvtState::stopping, PvtState::held}) {
        const auto bench = bench_in(state);
        CHECK(bench->feed(bench->status().next, steady(2, 1, 8000, 1.0)).refused == PvtRefusal::none);
    }
    const auto bench = bench_in(PvtState::homing);
    CHECK(bench->feed(bench->status().next, steady(2, 1, 8000, 1.0)).refused == no);
    CHECK(bench->feed(bench->status().next, {}).refused == PvtRefusal::none);
}

TEST_CASE("PVT drive: a command is executed once, and a late one not at all", "[drive][pvt]") {
    const auto bench = bench_in(PvtState::running);
    const PvtBlock hold{.session = 77, .command = PvtCommand::hold, .command_counter = 100, .argument = 0};
    CHECK(bench->send(hold).state == PvtState::stopping);
    bench->wait_us(1'000'000);
    const PvtBlock resume{.session = 77, .command = PvtCommand::resume, .command_counter = 101};
    CHECK(bench->send(resume).state == PvtState::running);
    CHECK(bench->send(resume).refused == PvtRefusal::none); // for the second time
    CHECK(bench->send(hold).state == PvtState::running);    // late
    CHECK(bench->status().refused == PvtRefusal::none);
    CHECK(bench->status().last_command == 101);
    PvtBlock begin{.session = 77, .command = PvtCommand::begin, .command_counter = 99, .argument = 5000};
    CHECK(bench->send(begin).next == 7);
    // A refused one can be sent again.
    const PvtBlock reset{.session = 77, .command = PvtCommand::fault_reset, .command_counter = 102};
    CHECK(bench->send(reset).refused == no);
    CHECK(bench->send(reset).refused == no);
    // A session that somebody else began: begin and quick stop find their way.
    begin.session = 78;
    CHECK(bench->send(begin).refused == no);
    CHECK(bench->send({.session = 78, .command = PvtCommand::hold, .command_counter = 103}).refused == session);
    CHECK(bench->send({.session = 78, .command = PvtCommand::quick_stop, .command_counter = 3}).refused ==
          PvtRefusal::none);
    bench->wait_us(1'000'000);
    begin.command_counter = 4;
    CHECK(bench->send(begin).next == 5000);
    CHECK(bench->send(begin).refused == PvtRefusal::none);
    begin.session = 79; // but the counter is that of the last one
    CHECK(bench->send(begin).refused == session);
}

TEST_CASE("PVT drive: enable with segments of no session is refused, begin brings its own", "[drive][pvt]") {
    PvtBench bench;
    CHECK(bench.command(PvtCommand::enable, 0, steady(2, 1, 8000, 1.0)).refused == session);
    CHECK(bench.state() == PvtState::disabled);
    static_cast<void>(bench.command(PvtCommand::enable));
    const PvtStatus status =
        bench.send({.session = 9, .command = PvtCommand::begin, .command_counter = 50, .argument = 7, .first = 7},
                   steady(2, 2, 8000, 1.0));
    CHECK(status.refused == PvtRefusal::none);
    CHECK(status.next == 9);
    CHECK(status.executed == 7);
}

TEST_CASE("PVT drive: place, home and quick stop are off the path, and end where they should", "[drive][pvt]") {
    auto bench = bench_in(PvtState::standing);
    std::vector<PvtSegment> place(1);
    place[0].end = {-(5 << 16), (std::int64_t{7} << 16) + 32768};
    PvtStatus status = bench->command(PvtCommand::preset_position, 0, place);
    CHECK(status.refused == PvtRefusal::none);
    CHECK(status.next == 0);
    CHECK(bench->drive.position_counts(0) == -5.0);
    CHECK(bench->drive.position_counts(1) == 7.5);
    CHECK(bench->command(PvtCommand::preset_position, 0, {place[0], place[0]}).refused == PvtRefusal::malformed);
    CHECK(bench->command(PvtCommand::home).state == PvtState::homing);
    bench->wait_us(1'000'000);
    status = bench->status();
    CHECK(status.state == PvtState::standing);
    CHECK(bench->drive.position_counts(0) == 0.0);
    CHECK(bench->drive.position_counts(1) == 0.0);
    // The session goes on, from there.
    CHECK(bench->feed(0, steady(2, 1, 8000, 1.0)).refused == PvtRefusal::none);
    CHECK(bench->command(PvtCommand::home).refused == no);

    bench = bench_in(PvtState::running);
    bench->wait_us(100000);
    const double at = bench->drive.position_counts(1);
    CHECK(bench->command(PvtCommand::quick_stop).state == PvtState::stopping);
    bench->wait_us(2000);
    CHECK(bench->state() == PvtState::standing);
    // v^2 / 2a with 2000 counts/s and 2e6 counts/s^2
    CHECK(bench->drive.position_counts(1) - at == Approx(1.0).margin(1e-6));
    CHECK(bench->command(PvtCommand::start).refused == session);
}

TEST_CASE("PVT drive: power off and on", "[drive][pvt]") {
    const auto bench = bench_in(PvtState::running);
    const PvtStatus before = bench->status();
    const double at = bench->drive.position_counts(0);
    bench->drive.power_cycle();
    const PvtStatus after = bench->status();
    CHECK(after.boot == before.boot + 1);
    CHECK(after.state == PvtState::disabled);
    CHECK(after.clock_us == 0);
    CHECK(after.next == 0);
    CHECK(after.executed == 0);
    CHECK(after.last_command == 0);
    CHECK(after.refusals == 0);
    bench->wait_us(100000);
    CHECK(bench->status().clock_us == 100000);
    CHECK(bench->drive.position_counts(0) == at);
    bench->counter = 0;
    bench->begin();
    CHECK(bench->state() == PvtState::standing);
    CHECK(bench->drive.position_counts(0) == at);
}

TEST_CASE("PVT drive: swapped words are seen in the identity, and a block's checksum fails", "[drive][pvt]") {
    PvtBench bench;
    bench.drive.swap_words();
    std::array<std::uint16_t, 11> identity{};
    REQUIRE(bench.drive.read(0, identity) == ModbusException::none);
    CHECK(identity[8] == 0x1234);
    CHECK(identity[9] == 0x5678);
    CHECK(identity[10] == 0x1234);
    REQUIRE(bench.drive.write(0x0100, bench.registers_of({.command = PvtCommand::enable, .command_counter = 1})) ==
            ModbusException::none);
    CHECK(bench.drive.status().refused == PvtRefusal::checksum);
    bench.drive.swap_words();
    CHECK(bench.command(PvtCommand::enable).state == PvtState::standing);
}
