// SPDX-License-Identifier: MIT
// Cyclic and block streams against the drive models: how near the shafts stay to the path.
#include "drive/driven_drive.hpp"
#include "drive/smooth_track.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "splinefeed/hal/modbus/setpoint/block_stream.hpp"
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <memory>
#include <numeric>
#include <random>

using namespace splinefeed;
using namespace splinefeed::hal::modbus;
using splinefeed::test::Circle;
using splinefeed::test::DrivenDrive;

namespace {

constexpr int wholes = 777; // the circle starts here, a whole count
const Circle circle(wholes);
const TrajectoryBuffer track = circle.track();

const DriveProfile& index_profile() {
    static const DriveProfile profile = host::find_profile("cia402-index");
    return profile;
}

/// One axis: its drive, when its frames arrive, and how far its shaft was off.
struct Axis {
    Axis(const std::string& profile, double start_counts, std::uint32_t period_us = 0)
        : drive(host::find_profile(profile), parameters(start_counts, period_us)) {
        drive.begin();
    }
    static host::ProfileDriveParameters parameters(double start_counts, std::uint32_t period_us) {
        host::ProfileDriveParameters out;
        out.axis.start_counts = start_counts;
        out.period_us = period_us;
        return out;
    }

    DrivenDrive drive;
    std::uint64_t next_us = 0;
    double worst = 0.0;

    void send(std::span<const RegisterWrite> writes) {
        for (const RegisterWrite& write : writes) {
            REQUIRE(drive.model().write(write.address, write.registers()) == host::ModbusException::none);
        }
    }
};

/// Runs both axes of a circle; `frame(axis, arrival_us)` gives what arrives then, `interval(axis)` when the next does.
/// The shafts are compared every half a millisecond, and must stand exactly at the end.
template <class Frame, class Interval>
void run(std::array<std::unique_ptr<Axis>, 2>& axes, const Frame& frame, const Interval& interval) {
    std::array<std::uint64_t, 2> begun_us{axes[0]->drive.now_us(), axes[1]->drive.now_us()};
    const auto end_us = static_cast<std::uint64_t>(circle.duration_s() * 1e6) + 300'000;
    for (std::uint64_t now_us = 0; now_us <= end_us; now_us += 100) {
        for (std::size_t k = 0; k < 2; ++k) {
            Axis& axis = *axes[k];
            axis.drive.wait_us(begun_us[k] + now_us - axis.drive.now_us());
            if (now_us >= axis.next_us) {
                axis.send(frame(k, now_us));
                axis.next_us = now_us + interval(k);
            }
            if (now_us % 500 == 0) {
                const double off =
                    axis.drive.model().position_counts(0) - circle.at(static_cast<double>(now_us) / 1e6)[k];
                axis.worst = std::max(axis.worst, std::fabs(off));
            }
        }
    }
}

std::array<std::unique_ptr<Axis>, 2> axes_of(const std::string& profile, std::uint32_t period_us = 0) {
    std::array<std::unique_ptr<Axis>, 2> axes;
    for (std::size_t k = 0; k < 2; ++k) {
        axes[k] = std::make_unique<Axis>(profile, circle.at(0.0)[k], period_us);
    }
    axes[1]->next_us = 1300; // the second one hears later
    return axes;
}

constexpr BlockSettings every_10_ms{.period_us = 10000, .acceleration = 1e6};

/// The blocks of one axis of the circle, from its beginning on. The profile must outlive them.
BlockStream blocks_of(const DriveProfile& profile, BlockSettings settings, int axis) {
    settings.axis = axis;
    BlockStream stream(profile, settings);
    stream.begin(circle.at(0.0)[static_cast<std::size_t>(axis)]);
    return stream;
}

std::array<BlockStream, 2> blocks_of_both(const DriveProfile& profile, const BlockSettings& settings) {
    return {blocks_of(profile, settings, 0), blocks_of(profile, settings, 1)};
}

/// The circle's first axis on a drive with blocks.
struct BlockAxis {
    explicit BlockAxis(const BlockSettings& settings = every_10_ms)
        : axis("oriental-az", circle.at(0.0)[0]), stream(blocks_of(profile, settings, 0)) {}

    DriveProfile profile = host::find_profile("oriental-az");
    Axis axis;
    BlockStream stream;
};

void check_end(const std::array<std::unique_ptr<Axis>, 2>& axes) {
    CHECK(axes[0]->drive.position() == wholes);
    CHECK(axes[1]->drive.position() == 0);
}

} // namespace

TEST_CASE("Cyclic targets: shafts stay within the chord of a period, though their frames come one after the other") {
    for (const std::uint32_t period_us : {2000U, 4000U, 10000U}) {
        auto axes = axes_of("cia402-index", period_us);
        std::array<CyclicStream, 2> streams{CyclicStream(index_profile(), {0, period_us}),
                                            CyclicStream(index_profile(), {1, period_us})};
        run(
            axes, [&](std::size_t k, std::uint64_t now_us) { return streams[k].frame(track, now_us); },
            [&](std::size_t) { return period_us; });
        const double period_s = period_us * 1e-6;
        const double chord = circle.acceleration() * period_s * period_s / 8.0;
        CAPTURE(period_us, chord, axes[0]->worst, axes[1]->worst);
        CHECK(axes[0]->worst < chord + 0.51);
        CHECK(axes[1]->worst < chord + 0.51);
        CHECK(std::max(axes[0]->worst, axes[1]->worst) > 0.5 * chord); // the bound is not idle
        check_end(axes);
        CHECK_FALSE(streams[0].clamped());
    }
}

TEST_CASE("Cyclic targets: more often than the drive's period, shafts stay within the chord of the interval") {
    constexpr std::uint32_t interval_us = 2500;
    auto axes = axes_of("cia402-index", 10000);
    std::array<CyclicStream, 2> streams{CyclicStream(index_profile(), {0, 10000, interval_us}),
                                        CyclicStream(index_profile(), {1, 10000, interval_us})};
    run(
        axes, [&](std::size_t k, std::uint64_t now_us) { return streams[k].frame(track, now_us); },
        [&](std::size_t) { return interval_us; });
    const double chord = circle.acceleration() * interval_us * interval_us * 1e-12 / 8.0;
    CAPTURE(chord, axes[0]->worst, axes[1]->worst);
    CHECK(axes[0]->worst < chord + 0.5 * 10000 / interval_us + 0.51); // its register rounds four times as much
    CHECK(axes[1]->worst < chord + 0.5 * 10000 / interval_us + 0.51);
    check_end(axes);
    CHECK(streams[0].end_sent(track, track.end_us()));
    CHECK_FALSE(streams[0].end_sent(track, track.end_us() - 1));
}

TEST_CASE("Cyclic targets: a drive that stood comes back to a path that stands with its acceleration") {
    constexpr std::uint32_t interval_us = 2000;
    constexpr double acceleration = 1e5;
    auto axes = axes_of("cia402-index", 10000);
    Axis& axis = *axes[1];
    CyclicStream stream(index_profile(), {1, 10000, interval_us, acceleration});
    const std::uint64_t gone_us = track.end_us() / interval_us * interval_us - 300'000;
    double velocity = 0.0;
    double furthest = 0.0;
    for (std::uint64_t now_us = 0; now_us < track.end_us() + 500'000; now_us += interval_us) {
        axis.drive.wait_us(interval_us);
        if (now_us > gone_us && now_us < gone_us + 400'000) { // its wire is gone: it stands
            continue;
        }
        if (now_us == gone_us + 400'000) {
            furthest = std::fabs(axis.drive.model().position_counts(0));
            stream.on_setpoint_timeout(track, {now_us, now_us, now_us + interval_us});
        }
        axis.send(stream.frame(track, now_us));
        if (now_us >= gone_us + 400'000) {
            axis.drive.wait_us(0);
            const double now = axis.drive.model().axis().reference().velocity_counts_s();
            CAPTURE(now_us, now, velocity);
            // By a whole count more or less of its register in a period, too.
            REQUIRE(std::fabs(now - velocity) < 1.1 * acceleration * interval_us * 1e-6 + 2.0 / 0.01);
            velocity = now;
        }
    }
    CHECK(furthest > 100.0);
    CHECK(axis.drive.position() == 0);
    CHECK(stream.end_sent(track, track.end_us()));
}

TEST_CASE("Cyclic targets: no shaft jumps, whenever a target takes effect, if it does") {
    constexpr std::uint32_t interval_us = 2000;
    constexpr std::uint32_t period_us = 10'000;
    const unsigned first = splinefeed_test::random_seed();
    for (unsigned seed = first; seed < first + static_cast<unsigned>(splinefeed_test::rounds(20)); ++seed) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        auto axes = axes_of("cia402-index", period_us);
        Axis& axis = *axes[1];
        CyclicStream stream(index_profile(), {1, period_us, interval_us, 1e5, Circle::speed_counts_s});
        stream.begin(track.at(1, 0).position_q16);
        const std::uint64_t begun_us = axis.drive.now_us();
        double most = 0.0;
        std::uint64_t arrived_us = 0;
        for (std::uint64_t now_us = 0; now_us < track.end_us();) {
            const MotionInstant instant{now_us, now_us, now_us + interval_us};
            if (now_us > arrived_us + period_us) {
                stream.on_setpoint_timeout(track, instant);
            }
            const auto writes = stream.frame(track, instant);
            const std::uint64_t answered_us = now_us + (random() % 4 == 0 ? random() % 40'000 : 200);
            const std::uint64_t effect_us = random() % 2 == 0 ? now_us : answered_us;
            const bool answers = random() % 6 != 0;
            axis.drive.wait_us(begun_us + effect_us - axis.drive.now_us());
            if (answers || random() % 2 == 0) {
                axis.send(writes);
            }
            axis.drive.wait_us(0);
            most = std::max(most, std::fabs(axis.drive.model().axis().reference().velocity_counts_s()));
            stream.on_arrival(now_us, answers ? answered_us : UINT64_MAX);
            arrived_us = answers ? std::midpoint(now_us, answered_us) : arrived_us;
            now_us = std::max(now_us + interval_us, answered_us);
        }
        CHECK(most < 1.3 * Circle::speed_counts_s);
    }
}

TEST_CASE("Cyclic targets: a drive may have followed a target that nobody confirmed, where the path turns round") {
    constexpr std::uint32_t period_us = 10'000;
    const auto way_q16 = [&](std::uint64_t at_us) {
        return std::abs(track.at(1, at_us + period_us).position_q16 - track.at(1, at_us).position_q16);
    };
    std::uint64_t middle_us = period_us; // where the axis is fastest
    for (std::uint64_t at_us = period_us; at_us < track.end_us(); at_us += period_us) {
        middle_us = way_q16(at_us) > way_q16(middle_us) ? at_us : middle_us;
    }
    for (const bool confirmed : {false, true}) {
        const std::int64_t begins_q16 = track.at(1, middle_us).position_q16;
        Axis axis("cia402-index", static_cast<double>(begins_q16) / 65536.0, period_us);
        CyclicStream stream(index_profile(), {1, period_us, period_us, 1e5, Circle::speed_counts_s});
        stream.begin(begins_q16);
        axis.send(stream.frame(track, {0, middle_us, middle_us + period_us}));
        stream.on_arrival(0, confirmed ? 0 : UINT64_MAX);
        axis.drive.wait_us(period_us);
        axis.send(stream.frame(track, {period_us, middle_us, middle_us - period_us})); // and back past the start
        axis.drive.wait_us(0);
        CHECK(std::fabs(axis.drive.model().axis().reference().velocity_counts_s()) < 1.3 * Circle::speed_counts_s);
        CHECK(stream.behind());
    }
}

TEST_CASE("Blocks on the fly: what arrived late is known when the next one is made") {
    // With the first two a block comes late where the axis turns: the drive runs past its target, and comes back.
    std::vector<unsigned> seeds{4204865798U, 3208929336U};
    const unsigned first = splinefeed_test::random_seed();
    for (unsigned i = 0; i < static_cast<unsigned>(splinefeed_test::rounds(100)); ++i) {
        seeds.push_back(first + i);
    }
    for (const unsigned seed : seeds) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        BlockAxis driven;
        driven.axis.send(driven.stream.prime());
        std::uint64_t now_us = 0;
        double worst = 0.0;
        for (int i = 0; now_us + 20'000 < track.end_us(); ++i) {
            const auto writes = driven.stream.block(track, now_us);
            // It knows where the drive is, but for what registers round.
            CAPTURE(i);
            REQUIRE(driven.axis.drive.model().position_counts(0) ==
                    Approx(driven.stream.position_counts()).margin(1.0));
            const double here = circle.at(static_cast<double>(now_us) * 1e-6)[0];
            worst = std::max(worst, std::fabs(driven.stream.position_counts() - here));
            const std::uint64_t late_us = random() % 4000;
            driven.axis.drive.wait_us(late_us);
            driven.axis.send(writes);
            driven.stream.on_arrival(now_us + late_us);
            driven.axis.drive.wait_us(10'000 - late_us);
            now_us += 10'000;
        }
        CHECK(worst < 40.0);
    }
}

TEST_CASE("Blocks on the fly: each profile's shafts stay near the path, and end exactly at its end") {
    for (const std::string name : {"cia402-kinco", "leadshine-pr", "oriental-az", "lexium32m"}) {
        for (const std::uint32_t period_us : {5000U, 10000U, 20000U}) {
            const DriveProfile profile = host::find_profile(name);
            auto axes = axes_of(name);
            auto streams = blocks_of_both(profile, {.period_us = period_us, .acceleration = 1e6});
            run(
                axes, [&](std::size_t k, std::uint64_t now_us) { return streams[k].block(track, now_us); },
                [&](std::size_t) { return period_us; });
            const double period_s = period_us * 1e-6;
            const RegisterField& speed = *profile.field_of(FieldRole::profile_velocity);
            const double speed_unit =
                static_cast<double>(speed.scale_denominator) / static_cast<double>(speed.scale_numerator);
            const double bound = circle.acceleration() * period_s * period_s / 8.0 + period_s * speed_unit / 2.0 + 0.51;
            CAPTURE(name, period_us, bound, axes[0]->worst, axes[1]->worst);
            CHECK(axes[0]->worst < bound);
            CHECK(axes[1]->worst < bound);
            check_end(axes);
            CHECK(axes[0]->drive.done());
            CHECK(streams[0].end_sent());
            CHECK_FALSE(streams[0].clamped());
        }
    }
}

TEST_CASE("Blocks on the fly: at each block the drive is on the path, ramps counted, and knows itself to be there") {
    BlockAxis driven;
    Axis& axis = driven.axis;
    BlockStream& stream = driven.stream;
    for (std::uint64_t now_us = 0; now_us + 20'000 < track.end_us(); now_us += 10'000) {
        axis.send(stream.block(track, now_us));
        CAPTURE(now_us);
        // At first the target itself is less than a unit away.
        CHECK(stream.position_counts() ==
              Approx(circle.at(static_cast<double>(now_us) / 1e6)[0]).margin(now_us <= 20'000 ? 0.51 : 0.02));
        CHECK(axis.drive.model().position_counts(0) == Approx(stream.position_counts()).margin(1e-3));
        axis.drive.wait_us(10'000);
    }
}

TEST_CASE("Blocks on the fly: a block that is late by the reserve finds the drive at its speed") {
    BlockSettings late = every_10_ms;
    late.reserve_us = 15000;
    BlockAxis driven(late);
    Axis& axis = driven.axis;
    BlockStream& stream = driven.stream;
    for (std::uint64_t now_us = 0; now_us <= 400'000; now_us += 10'000) {
        axis.drive.wait_us(now_us == 0 ? 0 : 10'000);
        axis.send(stream.block(track, now_us));
    }
    axis.drive.wait_us(10'000); // the ramp is over
    const double speed = axis.drive.model().axis().reference().velocity_counts_s();
    REQUIRE(std::fabs(speed) > 1000.0);
    axis.drive.wait_us(14'000);
    CHECK(axis.drive.model().axis().reference().velocity_counts_s() == speed);
    axis.drive.wait_us(100'000);
    CHECK_FALSE(axis.drive.model().axis().moving());
}

TEST_CASE("Blocks on the fly: intervals that vary, as long as the drive hears when it is known to") {
    const unsigned seed = splinefeed_test::random_seed();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const DriveProfile profile = host::find_profile("leadshine-pr");
    auto axes = axes_of("leadshine-pr");
    auto streams = blocks_of_both(profile, every_10_ms);
    run(
        axes, [&](std::size_t k, std::uint64_t now_us) { return streams[k].block(track, now_us); },
        [&](std::size_t) { return 8000 + 100 * (random() % 40); });
    CAPTURE(axes[0]->worst, axes[1]->worst);
    CHECK(axes[0]->worst < 6.0); // 12 ms: 3.6 counts of chord, and 2 ms at a speed that is out of date
    CHECK(axes[1]->worst < 6.0);
    check_end(axes);
}

TEST_CASE("Blocks on the fly: where the link dies the drive stops by itself, not far away") {
    BlockAxis driven;
    Axis& axis = driven.axis;
    BlockStream& stream = driven.stream;
    for (std::uint64_t now_us = 0; now_us < 700'000; now_us += 10'000) {
        axis.send(stream.block(track, now_us));
        axis.drive.wait_us(10'000);
    }
    const double speed = std::fabs(axis.drive.model().axis().reference().velocity_counts_s());
    const double here = axis.drive.model().position_counts(0);
    axis.drive.wait_ms(1000);
    CHECK_FALSE(axis.drive.model().axis().moving());
    CHECK(std::fabs(axis.drive.model().position_counts(0) - here) < speed * 0.011 + speed * speed / 2e6 + 1.0);
}
