// SPDX-License-Identifier: MIT
// SetpointPlant: a SetpointPort with drives of shipped profiles, all simulated.
#pragma once

#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/faulty_drive.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "ports/plant.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"
#include "support/catch.hpp"

#include <optional>

namespace splinefeed_test {

/// All that are shipped for drives which follow target positions.
inline constexpr std::array setpoint_profiles{"cia402-index", "lexium32m", "leadshine-pr", "oriental-az",
                                              "cia402-kinco"};

struct SetpointPlantParameters {
    std::string profile = "cia402-index";
    int drives = 3;
    bool one_wire = false;
    double acceleration_counts_s2 = 2e6; ///< of the first axis, as planned
    double fastest_counts_s = 60'000.0;  ///< of the first axis
    std::uint64_t seed = 1;
    double start_counts = 0.0;
    splinefeed::host::ModelFaults faults{}; ///< of each drive
    double standstill_counts = 2.0;         ///< of the first axis
    double quick_stop_counts_s2 = 16e6;     ///< of the first axis
    std::function<void(splinefeed::hal::modbus::DriveProfile&)>
        change_drives{};                                                  ///< of the profile that the drives have
    std::function<void(splinefeed::hal::modbus::DriveProfile&)> change{}; ///< of the profile, before drives are made
};

class SetpointPlant : public Plant {
public:
    explicit SetpointPlant(const SetpointPlantParameters& parameters)
        : profile(splinefeed::host::find_profile(parameters.profile)) {
        if (parameters.change) {
            parameters.change(profile);
        }
        for (int i = 0; i < parameters.drives; ++i) {
            if (i == 0 || !parameters.one_wire) {
                add_wire().random.seed(parameters.seed + static_cast<unsigned>(i));
            }
            const double share = std::fabs(way_share[static_cast<std::size_t>(i)]);
            splinefeed::host::ProfileDriveParameters parameters_of_drive;
            parameters_of_drive.period_us = profile.period_us;
            parameters_of_drive.acceleration_counts_s2 = 4.0 * share * parameters.acceleration_counts_s2;
            parameters_of_drive.axis.stop_counts_s2 = share * parameters.quick_stop_counts_s2;
            parameters_of_drive.axis.start_counts = parameters.start_counts;
            splinefeed::hal::modbus::DriveProfile theirs = profile;
            if (parameters.change_drives) {
                parameters.change_drives(theirs);
            }
            auto drive = std::make_unique<splinefeed::host::ProfileDrive>(theirs, parameters_of_drive);
            drives.push_back(drive.get());
            auto model = std::make_unique<splinefeed::host::FaultyDrive>(std::move(drive), theirs);
            model->set_faults(parameters.faults);
            const int unit = parameters.one_wire ? i + 1 : 1;
            add(std::move(model), unit, 0.0, *wires.back());
            wirings.push_back({.link = {.wire = profile.link.rtu ? Wire::rtu : Wire::tcp,
                                        .host = "line " + std::to_string(wires.size()),
                                        .port = 1502 + static_cast<int>(wires.size()) - 1,
                                        .unit = unit},
                               .profile = &profile,
                               .axis = i,
                               .acceleration_counts_s2 = share * parameters.acceleration_counts_s2,
                               .ramp_counts_s2 = 4.0 * share * parameters.acceleration_counts_s2,
                               .fastest_counts_s = share * parameters.fastest_counts_s,
                               .standstill_counts = parameters.standstill_counts});
        }
    }

    void make(splinefeed::hal::modbus::SetpointPortSettings settings = {}) {
        settings.make_wire = make_wire();
        settings.clock = &clock;
        port.emplace(wirings, settings);
    }

    /// Makes the port and opens it, and looks where the shafts are.
    void open(const splinefeed::hal::modbus::SetpointPortSettings& settings = {}) {
        make(settings);
        sample_positions();
        REQUIRE_FALSE(port->open());
    }

    /// Makes the port, and makes it ready for a motion. Returns what is wrong.
    [[nodiscard]] splinefeed::hal::PortFailure
    begin(const SmoothMotion& motion, const splinefeed::hal::modbus::SetpointPortSettings& settings = {}) {
        make(settings);
        REQUIRE_FALSE(port->open());
        auto failure = port->prepare(motion.segments.front());
        began_us = clock.now_us();
        next = 0;
        return failure;
    }

    splinefeed::hal::modbus::DriveProfile profile;
    std::vector<splinefeed::host::ProfileDrive*> drives;
    std::vector<splinefeed::hal::modbus::SetpointWiring> wirings;
    std::uint64_t began_us = 0;
    std::size_t next = 0;
    std::optional<splinefeed::hal::modbus::SetpointPort> port; // goes first

private:
    using Wire = splinefeed::hal::modbus::Wire;
};

} // namespace splinefeed_test
