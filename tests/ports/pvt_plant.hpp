// SPDX-License-Identifier: MIT
// PvtPlant: a ModbusPort with drives of the map splinefeed-pvt, all simulated.
#pragma once

#include "ports/lying_drive.hpp"
#include "ports/plant.hpp"
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"
#include "support/catch.hpp"

#include <optional>

namespace splinefeed_test {

/// Whether the failure is this problem.
inline bool names(const splinefeed::hal::PortFailure& failure, splinefeed::hal::modbus::DriveProblem problem) {
    return failure.what.rfind(describe(problem), 0) == 0;
}

struct PvtPlantParameters {
    std::vector<int> axes{1, 1, 1}; ///< of each drive
    bool one_wire = false;
    splinefeed::hal::modbus::Wire wire = splinefeed::hal::modbus::Wire::tcp;
    std::vector<double> clock_ppm{};
    splinefeed::host::PvtDriveParameters drive{};
    std::uint64_t seed = 1;
};

class PvtPlant : public Plant {
public:
    explicit PvtPlant(const PvtPlantParameters& parameters) {
        int axis = 0;
        for (std::size_t i = 0; i < parameters.axes.size(); ++i) {
            if (i == 0 || !parameters.one_wire) {
                add_wire().random.seed(parameters.seed + i);
            }
            splinefeed::host::PvtDriveParameters drive = parameters.drive;
            drive.axes.resize(static_cast<std::size_t>(parameters.axes[i]), drive.axes.front());
            drive.clock_start_us = parameters.seed * 0x9E3779B97F4A7C15U; // its clock may wrap at any time
            auto model = std::make_unique<LyingDrive>(drive);
            model->drive.machine().observe([this, i](const splinefeed::host::ExecutedSegment& segment) {
                executed[i].push_back(segment.sequence);
            });
            drives.push_back(&model->drive);
            liars.push_back(model.get());
            executed.emplace_back();
            const int unit = parameters.one_wire ? static_cast<int>(i) + 1 : 1;
            const double ppm = i < parameters.clock_ppm.size() ? parameters.clock_ppm[i] : 0.0;
            add(std::move(model), unit, ppm, *wires.back());
            splinefeed::hal::modbus::DriveWiring wiring{
                {.wire = parameters.wire, .port = 1502 + static_cast<int>(wires.size()) - 1, .unit = unit}, {}};
            wiring.link.host = "line " + std::to_string(wires.size());
            for (int k = 0; k < parameters.axes[i]; ++k) {
                wiring.axes.emplace_back(axis++);
            }
            wirings.push_back(wiring);
        }
    }

    void make(splinefeed::hal::modbus::ModbusPortSettings settings = {}) {
        settings.make_wire = make_wire();
        settings.clock = &clock;
        first_sequence = settings.first_sequence;
        port.emplace(wirings, settings);
    }
    /// Makes the port and opens it, and looks where the shafts are.
    void open(const splinefeed::hal::modbus::ModbusPortSettings& settings = {}) {
        make(settings);
        sample_positions();
        REQUIRE_FALSE(port->open());
    }
    /// And makes it ready for the motion.
    void begin(const SmoothMotion& motion, const splinefeed::hal::modbus::ModbusPortSettings& settings = {}) {
        open(settings);
        REQUIRE_FALSE(port->prepare(motion.segments.front()));
        began_us = clock.now_us();
    }
    /// Every segment from the first one on, in order, each once; how many, or nothing where that is not so.
    [[nodiscard]] std::optional<std::size_t> executed_once(std::size_t drive) const {
        for (std::size_t i = 0; i < executed[drive].size(); ++i) {
            if (executed[drive][i] != first_sequence + static_cast<std::uint32_t>(i)) {
                return std::nullopt;
            }
        }
        return executed[drive].size();
    }

    std::vector<splinefeed::host::PvtDrive*> drives;
    std::vector<LyingDrive*> liars;                   ///< the same drives
    std::vector<std::vector<std::uint32_t>> executed; ///< of each drive
    std::vector<splinefeed::hal::modbus::DriveWiring> wirings;
    std::uint32_t first_sequence = 0;
    std::uint64_t began_us = 0;                              ///< the run, behind prepare()
    std::size_t next = 0;                                    ///< of the segments that were not submitted yet
    std::optional<splinefeed::hal::modbus::ModbusPort> port; // goes first
};

} // namespace splinefeed_test
