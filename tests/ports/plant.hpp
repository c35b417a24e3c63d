// SPDX-License-Identifier: MIT
// Plant: simulated drives on simulated lines on one virtual clock, and what their shafts did.
#pragma once

#include "ports/simulated_link.hpp"
#include "ports/smooth_motion.hpp"
#include "support/virtual_clock.hpp"

#include <algorithm>

namespace splinefeed_test {

/// Who was where, looked at every millisecond, by the shafts themselves.
class Plant {
public:
    VirtualClock clock;
    std::vector<std::unique_ptr<SimulatedWire>> wires;
    std::vector<std::unique_ptr<splinefeed::host::DriveModel>> models;
    std::vector<std::unique_ptr<Station>> stations;
    /// What else happens at an instant. [us]
    std::vector<std::pair<std::uint64_t, std::function<void()>>> events;
    std::function<void()> each_ms; ///< called whenever the shafts are looked at

    Plant() = default;
    Plant(const Plant&) = delete;
    Plant& operator=(const Plant&) = delete;
    ~Plant() {
        sampling_ = false;
        sampler_.reset();
    }

    void add(std::unique_ptr<splinefeed::host::DriveModel> model, int unit, double clock_ppm, SimulatedWire& wire) {
        stations.push_back(std::make_unique<Station>(*model, clock_ppm));
        models.push_back(std::move(model));
        wire.stations[unit] = stations.back().get();
    }
    SimulatedWire& add_wire() {
        wires.push_back(std::make_unique<SimulatedWire>());
        return *wires.back();
    }
    /// A line whose address has the port 1502 + i hangs on wire i.
    [[nodiscard]] splinefeed::hal::modbus::MakeWire make_wire() {
        return [this](const auto& address, const auto& timing, auto& by) {
            auto& wire = *wires[static_cast<std::size_t>(address.port - 1502)];
            return std::make_unique<SimulatedLink>(wire, address, timing, by);
        };
    }
    /// From now on the shafts are looked at.
    void sample_positions() {
        sampler_ = clock.start([this] {
            while (sampling_) {
                sample_once();
                clock.sleep_us(1000);
            }
        });
    }
    void sample_once() {
        const std::uint64_t now_us = clock.now_us();
        for (auto& [at_us, what] : events) {
            if (what && now_us >= at_us) {
                what();
                what = nullptr;
            }
        }
        if (each_ms) {
            each_ms();
        }
        std::vector<double> here;
        for (std::size_t i = 0; i < stations.size(); ++i) {
            stations[i]->advance(now_us);
            for (int k = 0; k < models[i]->axes(); ++k) {
                here.push_back(models[i]->position_counts(k));
            }
        }
        double least = 1e300;
        double most = -1e300;
        for (std::size_t k = 0; k < here.size(); ++k) {
            least = std::min(least, here[k] / way_share[k]);
            most = std::max(most, here[k] / way_share[k]);
            const double step = positions.size() == here.size() ? std::fabs(here[k] - positions[k]) : 0.0;
            if (step > still_counts) {
                moved_us[k] = now_us;
            }
            most_step_counts = std::max(most_step_counts, step / std::fabs(way_share[k]));
        }
        off_path_counts = std::max(off_path_counts, most - least);
        now_off_counts = most - least;
        lowest_counts = std::min(lowest_counts, least);
        highest_counts = std::max(highest_counts, most);
        positions = here;
        moved_us.resize(here.size());
    }

    /// Steps of a shaft below this are its loop's settling.
    static constexpr double still_counts = 0.02;
    std::vector<double> positions;       ///< of all axes, drive by drive
    std::vector<std::uint64_t> moved_us; ///< when an axis was seen moving last
    double off_path_counts = 0.0;        ///< the most so far, by the first axis
    double now_off_counts = 0.0;
    double most_step_counts = 0.0; ///< that an axis moved from one look to the next, by the first axis
    double lowest_counts = 0.0;    ///< that any axis has been at so far, by the first axis
    double highest_counts = 0.0;

private:
    bool sampling_ = true;
    std::unique_ptr<splinefeed::hal::ClockThread> sampler_;
};

} // namespace splinefeed_test
