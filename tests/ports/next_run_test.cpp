// SPDX-License-Identifier: MIT
// However a run ended, the next one knows where the drives stand, or says that nobody knows, and moves them.
#include "ports/pvt_plant.hpp"
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

enum class Ending {
    finished,
    held,
    stopped,
    stopped_disabled,
    disabled,
    fault,
    power_cycle,
    homing_interrupted,
    never_prepared
};
constexpr std::array endings{Ending::finished,      Ending::held,  Ending::stopped,     Ending::stopped_disabled,
                             Ending::disabled,      Ending::fault, Ending::power_cycle, Ending::homing_interrupted,
                             Ending::never_prepared};
constexpr std::size_t troubled = 1; // the drive that something happens to

const SmoothMotion motion = smooth_motion(8000.0, 1, 200, 4000);

/// The same, but the first axis begins at this count, and the others as smooth_motion() has them.
SmoothMotion motion_from(const std::vector<double>& counts) {
    SmoothMotion out = smooth_motion(4000.0, 2, 100, 4000);
    for (FeedSegment& segment : out.segments) {
        for (std::size_t k = 0; k < counts.size(); ++k) {
            const std::int64_t shift = std::llround(counts[k]) * units_per_count;
            segment.start[k] += shift;
            segment.end[k] += shift;
        }
    }
    return out;
}

/// A drive in fault: it cannot follow.
void break_drive(PvtPlant& plant) {
    plant.drives[troubled]->machine().shaft(0).disturb(1e8);
}
void mend_drive(PvtPlant& plant) {
    plant.drives[troubled]->machine().shaft(0).disturb(0.0);
}
void break_drive(SetpointPlant& plant) {
    plant.drives[troubled]->axis().trip(host::AxisFault::following_error);
}

/// Runs to the end that is asked for.
template <class Plant, class Settings>
void first_run(Plant& plant, Settings settings, Ending ending) {
    settings.orders.home = ending == Ending::homing_interrupted;
    if (settings.orders.home) {
        settings.interrupted = [] {
            return true;
        };
    }
    plant.open(settings);
    if (ending == Ending::never_prepared) {
        return;
    }
    CHECK(bool(plant.port->prepare(motion.segments.front())) == settings.orders.home);
    if (settings.orders.home) {
        return;
    }
    plant.began_us = plant.clock.now_us();
    plant.next = 0;
    if (ending == Ending::fault) {
        plant.events.emplace_back(plant.began_us + 400'000, [&plant] { break_drive(plant); });
    } else if (ending == Ending::power_cycle) {
        plant.events.emplace_back(plant.began_us + 400'000, [&plant] { plant.models[troubled]->power_cycle(); });
    }
    Asked asked;
    const bool stops = ending == Ending::stopped || ending == Ending::stopped_disabled;
    asked.hold_us = ending == Ending::held || stops ? 400'000 : UINT64_MAX;
    asked.quick_us = stops ? 420'000 : UINT64_MAX;
    const PortPhase phase = run(plant, motion, asked);
    const bool broke = ending == Ending::fault || ending == Ending::power_cycle;
    CHECK(phase == (broke ? PortPhase::fault : asked.hold_us != UINT64_MAX ? PortPhase::halted : PortPhase::idle));
    if (ending == Ending::disabled || ending == Ending::stopped_disabled) {
        plant.port->power_off();
    }
}

/// Whether the drives know where they stand after it.
bool placed(Ending ending, std::size_t drive) {
    return ending != Ending::homing_interrupted && ending != Ending::never_prepared &&
           !(ending == Ending::power_cycle && drive == troubled);
}

template <class Plant>
void second_run(Plant& plant, const std::vector<double>& stands) {
    const SmoothMotion next = motion_from(stands);
    REQUIRE_FALSE(plant.port->prepare(next.segments.front()));
    plant.began_us = plant.clock.now_us();
    plant.next = 0;
    CHECK(run(plant, next, {}) == PortPhase::idle);
}

} // namespace

TEST_CASE("PVT port, virtual: the next run, however the one before ended", "[ports]") {
    for (const Ending ending : endings) {
        CAPTURE(static_cast<int>(ending));
        PvtPlant plant({});
        for (DriveWiring& wiring : plant.wirings) {
            wiring.following_window = 500;
        }
        for (host::PvtDrive* const drive : plant.drives) {
            drive->machine().shaft(0).preset_position(6030.0); // it counts from anywhere
        }
        first_run(plant, ModbusPortSettings{}, ending);
        plant.port.reset();
        plant.clock.sleep_us(1'000'000);
        mend_drive(plant);
        plant.clock.sleep_us(200'000);
        plant.events.clear();
        plant.make({.orders = {.reset = false}});
        REQUIRE_FALSE(plant.port->open());
        auto failure = plant.port->await_standstill();
        CHECK(bool(failure) == (ending == Ending::fault));
        if (failure) {
            CHECK(failure.drive == troubled);
            CHECK(names(failure, DriveProblem::fault));
            plant.make({.orders = {.reset = true}});
            REQUIRE_FALSE(plant.port->open());
            REQUIRE_FALSE(plant.port->await_standstill());
        }
        std::vector<double> stands;
        for (std::size_t i = 0; i < plant.drives.size(); ++i) {
            CHECK(plant.port->placed(i) == placed(ending, i));
            stands.push_back(plant.port->report(i).status.position[0]);
        }
        if (ending == Ending::finished || ending == Ending::disabled) {
            CHECK(std::fabs(stands[0] - 8000.0) <= 1.0); // of the machine, not of the drive that counted from 6030
            CHECK(std::fabs(stands[1] + 4000.0) <= 1.0);
        }
        plant.sample_once();
        const std::vector<double> before = plant.positions;
        second_run(plant, stands);
        for (std::size_t i = 0; i < plant.drives.size(); ++i) { // out and back
            CHECK(std::fabs(plant.positions[i] - before[i]) < 2.0);
        }
    }
}

TEST_CASE("Set-point port, virtual: the next run, however the one before ended", "[ports]") {
    for (const char* const profile : setpoint_profiles) {
        for (const Ending ending : endings) {
            CAPTURE(profile, static_cast<int>(ending));
            SetpointPlant plant({.profile = profile, .start_counts = 6030.0});
            const bool homes = !plant.profile.steps_of(DriveCommand::home).empty();
            if (ending == Ending::homing_interrupted && !homes) {
                continue;
            }
            first_run(plant, SetpointPortSettings{}, ending);
            plant.port.reset();
            plant.clock.sleep_us(1'000'000);
            plant.events.clear();
            plant.make({.orders = {.reset = false}});
            REQUIRE_FALSE(plant.port->open());
            if (const PortFailure failure = plant.port->await_standstill(); ending == Ending::fault) {
                CHECK(failure.what.find("it is in fault") == 0);
                CHECK(failure.remedy == Remedy::reset);
                CHECK(failure.drive == troubled);
                plant.make({.orders = {.reset = true}});
                REQUIRE_FALSE(plant.port->open());
                REQUIRE_FALSE(plant.port->await_standstill());
            } else {
                REQUIRE_FALSE(failure);
            }
            for (std::size_t i = 0; i < plant.drives.size(); ++i) {
                CHECK_FALSE(plant.port->placed(i)); // none was homed
            }
            second_run(plant, {0.0, 0.0, 0.0});
        }
    }
}

TEST_CASE("Set-point port, virtual: a drive that was homed knows where it stands, if its profile keeps that",
          "[ports]") {
    for (const auto& [profile, keeps] : {std::pair("cia402-index", false), std::pair("cia402-kinco", true),
                                         std::pair("leadshine-pr", true), std::pair("oriental-az", false)}) {
        CAPTURE(profile);
        SetpointPlant plant({.profile = profile});
        plant.open({.orders = {.home = true}});
        REQUIRE_FALSE(plant.port->prepare(motion.segments.front()));
        plant.began_us = plant.clock.now_us();
        plant.next = 0;
        REQUIRE(run(plant, motion, {}) == PortPhase::idle);
        plant.make({});
        REQUIRE_FALSE(plant.port->open());
        REQUIRE_FALSE(plant.port->await_standstill());
        CHECK(plant.port->placed(0) == keeps);
        CHECK(std::fabs(plant.port->standing_counts(0) - 8000.0) < 2.0);
    }
}
