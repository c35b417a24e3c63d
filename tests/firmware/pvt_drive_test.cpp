// SPDX-License-Identifier: MIT
#include "drive_bench.hpp"
#include "support/rounds.hpp"

#include <algorithm>
#include <random>
#include <support/catch.hpp>

using namespace firmware;

namespace {

constexpr std::uint32_t ms_ticks = 8000;

std::array<std::int32_t, drive_axes> ends_of(const std::vector<PvtSegment>& segments) {
    std::array<std::int32_t, drive_axes> ends{};
    for (unsigned k = 0; k < drive_axes; ++k) {
        ends[k] = static_cast<std::int32_t>((segments.back().end[k] + 32768) >> 16);
    }
    return ends;
}

/// The segments, from elsewhere on.
std::vector<PvtSegment> moved(std::vector<PvtSegment> segments, const std::array<std::int64_t, drive_axes>& by) {
    for (PvtSegment& segment : segments) {
        for (unsigned k = 0; k < drive_axes; ++k) {
            segment.end[k] += by[k];
        }
    }
    return segments;
}

} // namespace

TEST_CASE("Drive: a motion to its end, and every step of it", "[drive]") {
    for (const std::uint32_t ticks : {800U, 4 * ms_ticks, 5 * ms_ticks + 321}) {
        DriveBench bench;
        const std::vector<PvtSegment> segments = there_and_stop(60, ticks, ticks / 800.0);
        bench.enable_and_begin(40);
        bench.give_all(40, segments);
        CHECK(bench.status().next == 100);
        CHECK(bench.status().free == drive_ring - 60);
        bench.command(PvtCommand::start, bench.drive.clock_us() + 10'000);
        CHECK(bench.status().state == PvtState::standing);
        const std::uint32_t us = bench.run_until(PvtState::running) + bench.run_until(PvtState::standing);
        CHECK(us == Approx(10'000.0 + 60.0 * ticks / 8.0).margin(4.0 * slot_us));
        CHECK(bench.status().executed == 100);
        CHECK(bench.status().free == drive_ring);
        CHECK(bench.shaft == ends_of(segments));
        CHECK(bench.status().position[1] == bench.shaft[1]);
        CHECK(bench.steps.underruns() == 0);
    }
}

TEST_CASE("Drive: it starts at its instant, and a segment is executed when its steps are made", "[drive]") {
    DriveBench bench;
    constexpr std::uint32_t duration_us = 4000;
    bench.enable_and_begin();
    bench.give_all(0, there_and_stop(30, 8 * duration_us, 150.0));
    bench.run_us(350); // no multiple of a slot
    const std::uint32_t start_us = bench.drive.clock_us() + 7450;
    bench.command(PvtCommand::start, start_us);
    std::uint32_t executed = 0;
    while (executed < 30 && bench.drive.clock_us() < start_us + 200'000) {
        bench.run_us(drive_tick_us);
        const std::uint32_t now_us = bench.drive.clock_us();
        if (bench.status().executed != executed) {
            executed = bench.status().executed;
            CHECK(now_us >= start_us + executed * duration_us);
            CHECK(now_us <= start_us + executed * duration_us + slot_us + 4 * drive_tick_us);
        }
    }
    CHECK(executed == 30);
}

TEST_CASE("Drive: the ring ends, it stands on the path, and resumes", "[drive]") {
    DriveBench bench;
    const std::vector<PvtSegment> segments = there_and_stop(50, 8 * ms_ticks, 700.0);
    bench.start(std::span(segments).first(25));
    bench.run_until(PvtState::held);
    CHECK(bench.status().state == PvtState::held);
    CHECK(bench.status().executed == 25);
    CHECK(std::abs(bench.shaft[0] - static_cast<int>(segments[24].end[0] >> 16)) <= 1);
    bench.give_all(25, std::span(segments).subspan(25));
    bench.run_us(100'000);
    CHECK(bench.status().state == PvtState::held); // only resume continues
    bench.command(PvtCommand::resume);
    bench.run_until(PvtState::standing);
    CHECK(bench.shaft == ends_of(segments));
}

TEST_CASE("Drive: a hold stands within the reserve, and nothing is lost", "[drive]") {
    DriveBench bench;
    const std::vector<PvtSegment> segments = there_and_stop(50, 8 * ms_ticks, 700.0);
    bench.start(segments);
    bench.run_us(150'000);
    CHECK(bench.command(PvtCommand::hold, bench.drive.clock_us() + 10'000).state == PvtState::running);
    const std::uint32_t us = bench.run_until(PvtState::held);
    CHECK(us == Approx(210'000.0).margin(4.0 * slot_us));
    CHECK(bench.status().executed < 50);
    bench.command(PvtCommand::resume);
    bench.run_until(PvtState::standing);
    CHECK(bench.shaft == ends_of(segments));
}

TEST_CASE("Drive: blocks that are sent twice, late, damaged or with a gap", "[drive]") {
    DriveBench bench;
    const std::vector<PvtSegment> segments = there_and_stop(20, 4 * ms_ticks, 200.0);
    bench.enable_and_begin();
    bench.give(0, std::span(segments).first(5));
    const std::vector<std::uint8_t> late = bench.last_frame;
    CHECK(bench.give(6, std::span(segments).subspan(6, 2)).refused == PvtRefusal::gap);
    CHECK(bench.give(3, std::span(segments).subspan(3, 5)).refused == PvtRefusal::none);
    CHECK(DriveBench::status_of(bench.ask(late)).next == 8);
    CHECK(bench.status().nonce != bench.nonce); // the late block's

    modbus::PvtBlock head;
    head.session = bench.session;
    head.count = 1;
    head.first = 8;
    modbus::PvtBlockRegisters raw{};
    const std::size_t size = encode(head, std::span(segments).subspan(8, 1), drive_axes, raw);
    raw[size - 1] ^= 1U; // in front of the CRC of the frame
    CHECK(DriveBench::status_of(bench.ask(exchange_request(std::span<const std::uint16_t>(raw).first(size)))).refused ==
          PvtRefusal::checksum);
    CHECK(bench.status().next == 8);
    CHECK(bench.status().refusals == 2);

    head.session = 1;
    head.count = 0;
    CHECK(bench.send(head).refused == PvtRefusal::session);
    bench.give_all(8, std::span(segments).subspan(8));
    bench.command(PvtCommand::start);
    const std::vector<std::uint8_t> start = bench.last_frame;
    bench.run_us(20'000);
    static_cast<void>(bench.ask(start)); // its counter is not new
    bench.run_until(PvtState::standing);
    static_cast<void>(bench.ask(start));
    bench.run_us(20'000);
    CHECK(bench.status().state == PvtState::standing);
    CHECK(bench.shaft == ends_of(segments));
}

TEST_CASE("Drive: commands that do not fit", "[drive]") {
    DriveBench bench;
    CHECK(bench.command(PvtCommand::begin).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::start).refused == PvtRefusal::session);
    CHECK(bench.status().last_command == 0);
    bench.counter = 0; // a refused command leaves its counter new
    bench.enable_and_begin();
    CHECK(bench.status().last_command == 2);
    CHECK(bench.command(PvtCommand::resume).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::hold).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::home).refused == PvtRefusal::state);
    CHECK(bench.command(static_cast<PvtCommand>(99)).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::start).state == PvtState::standing);
    bench.run_us(1000);
    CHECK(bench.status().state == PvtState::held); // an empty ring
    CHECK(bench.command(PvtCommand::disable).state == PvtState::disabled);
    CHECK(bench.give(0, there_and_stop(1, 8000, 1.0)).refused == PvtRefusal::session);
}

TEST_CASE("Drive: a preset position is where the next motion begins", "[drive]") {
    DriveBench bench;
    bench.enable_and_begin();
    std::vector<PvtSegment> place(1);
    place[0].duration_ticks = 8000;
    place[0].end = {1000 * 65536, -2000 * 65536, 33000};
    modbus::PvtBlock head;
    head.session = bench.session;
    head.command = PvtCommand::preset_position;
    head.command_counter = ++bench.counter;
    CHECK(bench.send(head, place).position[1] == -2000);
    CHECK(bench.status().position[2] == 1);
    const std::int64_t* const from = place[0].end.data();
    bench.give_all(0, moved(there_and_stop(20, 5 * ms_ticks, 300.0), {from[0], from[1], from[2]}));
    bench.command(PvtCommand::start);
    bench.run_until(PvtState::running);
    bench.run_until(PvtState::standing);
    CHECK(bench.shaft[0] == 300);
    CHECK(bench.status().position[0] == 1300);
    CHECK(bench.status().position[1] == -1850);
}

TEST_CASE("Drive: the end moves to an earlier segment, if it can stop there", "[drive]") {
    DriveBench bench;
    const std::vector<PvtSegment> segments = there_and_stop(60, 10 * ms_ticks, 700.0);
    bench.start(segments);
    bench.run_us(200'000); // in segment 20
    CHECK(bench.command(PvtCommand::end, 25).refused == PvtRefusal::state);
    --bench.counter;
    CHECK(bench.command(PvtCommand::end, 40).next == 40);
    bench.run_until(PvtState::held);
    CHECK(bench.status().executed == 40);
    bench.give_all(40, std::span(segments).subspan(40));
    bench.command(PvtCommand::resume);
    bench.run_until(PvtState::standing);
    CHECK(bench.shaft == ends_of(segments));
}

TEST_CASE("Drive: without blocks the watchdog holds it, on the path", "[drive]") {
    DriveBench bench;
    bench.drive.configure({.watchdog_ms = 100, .stop_reserve_ms = 50, .following_window = 0});
    const std::vector<PvtSegment> segments = there_and_stop(60, 10 * ms_ticks, 700.0);
    bench.start(segments);
    const std::uint32_t us = bench.run_until(PvtState::held);
    CHECK(us == Approx(200'000.0).margin(4.0 * slot_us));
    CHECK(bench.drive.fault() == PvtFault::watchdog);
    CHECK(bench.command(PvtCommand::resume, bench.status().clock_us - 100'000).refused ==
          PvtRefusal::state); // too late to be watched
    CHECK(bench.drive.state() == PvtState::held);
    bench.drive.configure({.watchdog_ms = 0, .stop_reserve_ms = 50, .following_window = 0});
    bench.command(PvtCommand::resume);
    bench.run_until(PvtState::standing);
    CHECK(bench.drive.fault() == PvtFault::none);
    CHECK(bench.shaft == ends_of(segments));
}

TEST_CASE("Drive: a quick stop, a limit switch and an emergency stop lose the ring", "[drive]") {
    for (const int kind : {0, 1, 2}) {
        DriveBench bench;
        bench.start(there_and_stop(60, 8 * ms_ticks, 2000.0));
        bench.run_us(240'000);
        const std::array<std::int32_t, drive_axes> before = bench.shaft;
        bench.limit = kind == 1;
        bench.estop = kind == 2;
        if (kind == 0) {
            bench.command(PvtCommand::quick_stop);
            CHECK(bench.status().state == PvtState::stopping);
        }
        bench.run_us(100'000);
        const std::int32_t way = bench.shaft[0] - before[0];
        CHECK(bench.status().state == (kind == 0 ? PvtState::standing : PvtState::fault));
        CHECK(bench.drive.fault() == (kind == 0   ? PvtFault::none
                                      : kind == 1 ? PvtFault::limit
                                                  : PvtFault::emergency_stop));
        CHECK(bench.drive.powered() == (kind != 2));
        CHECK(way <= (kind == 2 ? 0 : 250));
        CHECK(way >= (kind == 2 ? 0 : 50));
        CHECK(bench.status().next == bench.status().executed);
        CHECK_FALSE(bench.drive.session().has_value());
        CHECK(bench.status().position[2] == bench.shaft[2]);
        CHECK(bench.command(PvtCommand::start).refused == PvtRefusal::session);

        bench.limit = bench.estop = false;
        bench.run_us(1000);
        std::array<std::int64_t, drive_axes> stopped{};
        std::ranges::transform(bench.shaft, stopped.begin(), [](std::int64_t counts) { return counts * 65536; });
        if (kind != 0) {
            CHECK(bench.command(PvtCommand::fault_reset).state == PvtState::disabled);
            bench.command(PvtCommand::enable);
        }
        bench.command(PvtCommand::begin, 5);
        const std::vector<PvtSegment> segments = moved(there_and_stop(20, 8 * ms_ticks, 100.0), stopped);
        bench.give_all(5, segments);
        bench.command(PvtCommand::start);
        bench.run_until(PvtState::running);
        bench.run_until(PvtState::standing);
        CHECK(bench.shaft == ends_of(segments));
    }
}

TEST_CASE("Drive: an emergency stop that stays open lets nothing be enabled", "[drive]") {
    DriveBench bench;
    bench.estop = true;
    bench.run_us(1000);
    CHECK(bench.drive.state() == PvtState::disabled);
    bench.command(PvtCommand::enable);
    bench.run_us(1000);
    CHECK(bench.drive.state() == PvtState::fault);
    CHECK_FALSE(bench.drive.powered());
}

TEST_CASE("Drive: a segment that is too fast for the ticks is a fault of its axis", "[drive]") {
    for (const double counts : {3.0e3, 4.0e5}) {
        DriveBench bench;
        std::vector<PvtSegment> segments = there_and_stop(20, 8 * ms_ticks, 10.0);
        segments[10].end[1] += static_cast<std::int64_t>(counts * 65536.0);
        bench.start(segments);
        bench.run_until(PvtState::fault);
        CHECK(bench.drive.fault() == PvtFault::limit);
        CHECK(bench.drive.fault_axis() == 1);
        bench.run_us(100'000);
        CHECK(std::abs(bench.shaft[1]) < 200);
        CHECK(bench.status().position[1] == bench.shaft[1]);
    }
}

TEST_CASE("Drive: rests on the way, holds and ends at random: the path's end, step by step", "[drive][random]") {
    for (unsigned seed = 0; seed < static_cast<unsigned>(splinefeed_test::rounds(40)); ++seed) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        DriveBench bench;
        std::vector<PvtSegment> segments;
        std::array<std::int64_t, drive_axes> at{};
        for (int leg = 0; leg < 6; ++leg) { // each ends with the rest mark
            const int count = 3 + static_cast<int>(random() % 30);
            const std::uint32_t ticks = 800 + static_cast<std::uint32_t>(random() % 60'000);
            const double most = 4000.0 * count * ticks / 8e6 / 1.5;
            const std::vector<PvtSegment> part =
                moved(there_and_stop(count, ticks, most * (random() % 2 == 0 ? 0.9 : -0.9)), at);
            for (unsigned k = 0; k < drive_axes; ++k) {
                at[k] = part.back().end[k];
            }
            segments.insert(segments.end(), part.begin(), part.end());
        }
        bench.enable_and_begin(0xFFFF'FFF0); // the numbers wrap
        const std::uint32_t first = 0xFFFF'FFF0;
        for (int round = 0; round < 4000 && bench.status().executed != first + segments.size(); ++round) {
            const modbus::PvtStatus status = bench.status();
            const std::uint32_t known = status.next - first;
            const std::size_t count = std::min<std::size_t>({random() % 6, segments.size() - known, status.free});
            if (random() % 8 != 0 || status.state != PvtState::running) {
                bench.give(status.next, std::span(segments).subspan(known, count));
            }
            switch (status.state == PvtState::running ? random() % 40 : 40 + random() % 3) {
            case 0:
                bench.command(PvtCommand::hold, bench.drive.clock_us() + static_cast<std::uint32_t>(random() % 20'000));
                break;
            case 1: bench.command(PvtCommand::end, status.executed + static_cast<std::uint32_t>(random() % 20)); break;
            case 40:
                bench.command(PvtCommand::start, bench.drive.clock_us() + static_cast<std::uint32_t>(random() % 3000));
                break;
            case 41:
                bench.command(PvtCommand::resume, bench.drive.clock_us() + static_cast<std::uint32_t>(random() % 3000));
                break;
            default: break;
            }
            bench.run_us(static_cast<std::uint32_t>(random() % 20'000));
            REQUIRE(bench.drive.state() != PvtState::fault);
        }
        bench.run_us(10'000);
        CHECK(bench.status().executed == first + static_cast<std::uint32_t>(segments.size()));
        CHECK(bench.shaft == ends_of(segments));
    }
}

TEST_CASE("Drive: a limit switch that is pressed from the start is left, or stops the axes", "[drive]") {
    for (const bool releases : {false, true}) {
        DriveBench bench;
        bench.limit = true;
        bench.run_us(1000);
        bench.start(there_and_stop(60, 8 * ms_ticks, 2000.0));
        const std::uint32_t took = bench.run_until(PvtState::fault, 100'000);
        CHECK(took == 100'000); // so far it may leave it
        bench.limit = !releases;
        bench.run_us(releases ? 50'000 : 400'000);
        CHECK(bench.drive.fault() == (releases ? PvtFault::none : PvtFault::limit));
        CHECK((releases || std::abs(bench.shaft[0]) <= static_cast<int>(drive_leaving_steps) + 250));
        bench.limit = true; // left once, it stops at once
        bench.run_us(100'000);
        CHECK(bench.drive.fault() == PvtFault::limit);
    }
}

TEST_CASE("Drive: the ends of the range of positions are refused or told, and overflow nothing", "[drive]") {
    constexpr std::int64_t least = -(std::int64_t{1} << 47);
    constexpr std::int64_t most = -(least + 1);
    for (const std::int64_t end : {least, most}) {
        DriveBench bench;
        bench.enable_and_begin();
        std::vector<PvtSegment> place(1);
        place[0].duration_ticks = 8000;
        place[0].end[0] = end;
        modbus::PvtBlock head;
        head.session = bench.session;
        head.command = PvtCommand::preset_position;
        head.command_counter = ++bench.counter;
        CHECK(bench.send(head, place).refused == (end == most ? PvtRefusal::malformed : PvtRefusal::none));
        std::vector<PvtSegment> segments = there_and_stop(20, 8 * ms_ticks, 100.0);
        for (PvtSegment& segment : segments) { // to the other end of the range
            segment.end[0] = -(end + 1);
        }
        bench.give_all(0, segments);
        bench.command(PvtCommand::start);
        bench.run_us(300'000);
        CHECK(bench.drive.fault() == PvtFault::limit); // faster than any board
        CHECK(bench.shaft[0] == 0);
    }
}
