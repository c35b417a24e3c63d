// SPDX-License-Identifier: MIT
// DriveWorld: three simulated Modbus drives, one for each axis. PvtWorld: they interpolate. SetpointWorld: they follow
// target positions, by a profile.
#pragma once

#include "host_sim/config/drive_table.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/faulty_drive.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "host_sim/drive/pvt_drive.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/ports/modbus/pvt_target.hpp"
#include "host_sim/ports/modbus/setpoint_target.hpp"
#include "live/shaft_world.hpp"
#include "ports/plant.hpp"

#include <sstream>
#include <unistd.h>

namespace splinefeed_test {

class DriveWorld : public ShaftWorld {
public:
    [[nodiscard]] host::RunTarget& target() override {
        if (!target_) {
            std::string text = head_ + served_machine();
            for (unsigned k = 0; k < 3; ++k) {
                const std::string name = std::string("name = \"") + "xyz"[k] + "\"\n";
                text.replace(text.find(name), name.size(), name + "drive = \"" + address(k) + "\"\n");
                SimulatedWire& wire = k == 0 || !one_wire_ ? plant_.add_wire() : *plant_.wires[0];
                plant_.add(make_drive(k), unit(k), 0.0, wire);
            }
            take(host::parse_machine(text, "machine.toml"));
            target_ =
                make_target(host::drive_table("modbus", description()), {.interrupted = &host::LiveMachine::gives_up},
                            {.make =
                                 [this](auto link, const auto& timing, auto& by) {
                                     link.port = 1502 + (link.host.back() - '1'); // as the plant has its wires
                                     return plant_.make_wire()(link, timing, by);
                                 },
                             .clock = &clock});
            fit(*target_);
        }
        return *target_;
    }
    [[nodiscard]] std::uint32_t told() const override { return told_; }
    /// told BITS, starts X Y Z, ramp MM_S2, off-at-end: before it begins. silent y [MS], frozen y [MS]: for so long, or
    /// for ever. unplugged MS: all of them. fault y, stops y: by itself. deaf y: to every stop. restarts y.
    void set(const std::string& fact, const std::string& value) override {
        std::istringstream words(value);
        char axis = 'x';
        if (fact == "told") {
            words >> told_;
        } else if (fact == "starts") {
            words >> start_mm_[0] >> start_mm_[1] >> start_mm_[2];
        } else if (fact == "ramp") {
            words >> stop_mm_s2_;
        } else if (fact == "off-at-end") {
            head_ = "drives_at_end = \"off\"\n";
        } else if (fact == "unplugged") {
            const Span away = span(words);
            for (auto& wire : plant_.wires) {
                wire->unplugged.push_back(away);
            }
        } else {
            static_cast<void>(target());
            words >> axis;
            const unsigned k = axis_of({axis});
            Station& station = *plant_.stations[k];
            station.advance(clock.now_us());
            fact == "silent"     ? station.mute.push_back(span(words))
            : fact == "frozen"   ? station.frozen.push_back(span(words))
            : fact == "deaf"     ? plant_.models[k]->set_faults({.refuses_stops = true})
            : fact == "restarts" ? plant_.models[k]->power_cycle()
                                 : trouble(fact, k, true);
        }
    }
    void clear(const std::string& fact) override {
        for (unsigned k = 0; k < 3; ++k) {
            plant_.stations[k]->mute.clear();
            trouble(fact, k, false);
        }
    }
    [[nodiscard]] double mm(unsigned axis) override {
        static_cast<void>(target());
        plant_.stations[axis]->advance(clock.now_us());
        return plant_.models[axis]->position_counts(0) / counts_per_mm;
    }
    /// power: the axes whose drives hold them.
    [[nodiscard]] std::optional<std::string> answer_to(const std::string& word) override {
        std::string out;
        for (unsigned k = 0; word == "power" && k < 3; ++k) {
            out += is_on(k) ? std::string(1, "xyz"[k]) : "";
        }
        return word == "power" ? std::optional(out) : std::nullopt;
    }
    [[nodiscard]] bool powered() override { return is_on(0) || is_on(1) || is_on(2); }

protected:
    /// @param serial, one_wire  by which the drives are reached
    DriveWorld(const Nearness& nearness, bool serial, bool one_wire)
        : ShaftWorld(nearness), serial_(serial), one_wire_(one_wire) {}

    [[nodiscard]] virtual std::string keys() const { return {}; } ///< of an address
    [[nodiscard]] virtual std::unique_ptr<host::DriveModel> make_drive(unsigned axis) = 0;
    [[nodiscard]] virtual std::unique_ptr<host::RunTarget>
    make_target(host::DriveTable table, const host::RunOptions& options, const host::DriveWires& lines) = 0;
    virtual void trouble(const std::string& fact, unsigned axis, bool begins) = 0;
    [[nodiscard]] virtual bool is_on(unsigned axis) = 0;

    [[nodiscard]] double start_counts(unsigned axis) const { return start_mm_[axis] * counts_per_mm; }
    [[nodiscard]] double stop_counts_s2() const { return stop_mm_s2_ * counts_per_mm; }

private:
    [[nodiscard]] int unit(unsigned axis) const { return one_wire_ ? static_cast<int>(axis) + 1 : 1; }
    [[nodiscard]] std::string address(unsigned axis) const {
        return fmt::format("modbus-{}of{}-{}?unit={}{}", serial_ ? "rtu:///" : "tcp://", getpid(),
                           one_wire_ ? 1 : axis + 1, unit(axis), keys());
    }
    [[nodiscard]] Span span(std::istringstream& words) const {
        std::uint64_t ms = 0;
        const bool ends = static_cast<bool>(words >> ms);
        return {clock.now_us(), ends ? clock.now_us() + 1000 * ms : UINT64_MAX};
    }

    bool serial_;
    bool one_wire_;
    Plant plant_;      // of which the clock is not used
    std::string head_; // of the machine file
    std::uint32_t told_ = 7;
    std::array<double, 3> start_mm_{};
    double stop_mm_s2_ = 6250.0;
    std::unique_ptr<host::RunTarget> target_; // goes first
};

class PvtWorld final : public DriveWorld {
public:
    explicit PvtWorld(bool serial)
        : DriveWorld({.told_counts = 1.0, .path_counts = 3.2, .stop_ms = serial ? 700.0 : 500.0}, serial, serial) {}

private:
    [[nodiscard]] std::unique_ptr<host::DriveModel> make_drive(unsigned axis) override {
        host::PvtDriveParameters parameters;
        parameters.axes[0].start_counts = start_counts(axis);
        parameters.axes[0].stop_counts_s2 = stop_counts_s2();
        auto drive = std::make_unique<host::PvtDrive>(parameters);
        drives_[axis] = drive.get();
        return drive;
    }
    [[nodiscard]] std::unique_ptr<host::RunTarget> make_target(host::DriveTable table, const host::RunOptions& options,
                                                               const host::DriveWires& lines) override {
        return std::make_unique<host::PvtTarget>(std::move(table), description(), options, lines);
    }
    void trouble(const std::string& fact, unsigned axis, bool begins) override {
        if (fact == "fault") { // a load moves it away from where it should be
            auto& machine = drives_[axis]->machine();
            auto configuration = machine.configuration();
            configuration.following_window = begins ? 1 : 0;
            machine.configure(configuration);
            machine.shaft(0).disturb(begins ? 1e7 : 0.0);
        }
    }
    [[nodiscard]] bool is_on(unsigned axis) override {
        const auto state = drives_[axis]->machine().state();
        return state != hal::modbus::PvtState::disabled && state != hal::modbus::PvtState::fault;
    }

    std::array<host::PvtDrive*, 3> drives_{};
};

class SetpointWorld final : public DriveWorld {
public:
    static constexpr std::array profiles{"cia402-index", "lexium32m", "leadshine-pr", "oriental-az", "cia402-kinco"};

    explicit SetpointWorld(const std::string& profile)
        : DriveWorld({.told_counts = 2.0, .path_counts = 12.0, .stop_ms = stop_ms(profile)},
                     host::find_profile(profile).link.rtu, profile == "leadshine-pr" || profile == "oriental-az"),
          profile_(host::find_profile(profile)) {}

private:
    // A hold travels what is ahead of the drives: the more, the longer they wait for a target on their wires.
    static double stop_ms(const std::string& profile) {
        return profile == "cia402-kinco" ? 750.0 : profile == "oriental-az" ? 500.0 : 400.0;
    }
    // Ramps of four times the machine file's acceleration: the path may use all of it.
    [[nodiscard]] std::string keys() const override {
        return (profile_.name == "cia402-index" ? "" : "&ramp=1.28e6") + ("&profile=" + profile_.name);
    }
    [[nodiscard]] std::unique_ptr<host::DriveModel> make_drive(unsigned axis) override {
        host::ProfileDriveParameters parameters;
        parameters.acceleration_counts_s2 = 1.28e6;
        parameters.axis.start_counts = start_counts(axis);
        parameters.axis.stop_counts_s2 = stop_counts_s2();
        parameters.period_us = profile_.period_us;
        auto drive = std::make_unique<host::ProfileDrive>(profile_, parameters);
        drives_[axis] = drive.get();
        return std::make_unique<host::FaultyDrive>(std::move(drive), profile_);
    }
    [[nodiscard]] std::unique_ptr<host::RunTarget> make_target(host::DriveTable table, const host::RunOptions& options,
                                                               const host::DriveWires& lines) override {
        return std::make_unique<host::SetpointTarget>(std::move(table), description(), options, lines);
    }
    void trouble(const std::string& fact, unsigned axis, bool begins) override {
        if (begins) {
            fact == "stops"   ? drives_[axis]->stop_by_itself()
            : fact == "fault" ? drives_[axis]->axis().trip(host::AxisFault::following_error)
                              : throw std::invalid_argument(fact);
        }
    }
    [[nodiscard]] bool is_on(unsigned axis) override { return drives_[axis]->axis().power() == host::AxisPower::on; }

    hal::modbus::DriveProfile profile_;
    std::array<host::ProfileDrive*, 3> drives_{};
};

} // namespace splinefeed_test
