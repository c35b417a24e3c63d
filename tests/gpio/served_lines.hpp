// SPDX-License-Identifier: MIT
// ServedLines: a machine on simulated lines that senders operate, in virtual time: all of `splinefeed serve` but its
// sockets.
#pragma once

#include "host_sim/config/gpio_map.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "host_sim/ports/gpio/line_outputs.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "host_sim/serve/served_motion.hpp"
#include "recorded_chips.hpp"
#include "simulated_lines.hpp"
#include "splinefeed/controller/controller.hpp"
#include "support/places.hpp"
#include "support/virtual_clock.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace splinefeed_test {

/// Of tests/serve/machine.toml: a switch at the end of each axis, which is limit and home, and a probe.
inline const std::string served_map = [] {
    std::string text = "[enable]\nline = 6\nsettle_ms = 5\n";
    for (const char axis : {'x', 'y', 'z'}) {
        const int k = axis - 'x';
        text += "[axis." + std::string(1, axis) + "]\nstep = " + std::to_string(2 * k) +
                "\ndirection = " + std::to_string(2 * k + 1) + "\n[home." + axis +
                "]\nseek_mm_s = 50\nlatch_mm_s = 5\npull_off_mm = 2\n" +
                (axis == 'z' ? "towards = \"high\"\nposition_mm = 2\n" : "towards = \"low\"\nposition_mm = -2\n");
        for (const char* const role : {"home", "limit"}) {
            text += "[[input]]\nrole = \"" + std::string(role) + "\"\naxis = \"" + axis +
                    "\"\nline = " + std::to_string(10 + k) + "\n";
        }
    }
    return text + "[[input]]\nrole = \"e-stop\"\nline = 20\n[[input]]\nrole = \"drive-fault\"\nline = 21\n"
                  "[[input]]\nrole = \"probe\"\nline = 22\n";
}();

inline std::string served_machine() {
    std::ifstream file(splinefeed::test::source_folder() + "/tests/serve/machine.toml");
    return {std::istreambuf_iterator<char>(file), {}};
}

class ServedLines {
public:
    // Inputs of the map: those of an axis are home and limit.
    static constexpr std::size_t e_stop = 6;
    static constexpr std::size_t drive_fault = 7;
    static constexpr std::size_t probe = 8;
    static constexpr std::size_t limit_of(unsigned axis) { return 2 * axis + 1; }

    /// @param told  axes whose place is known, by bits: they stand at 0
    /// @param machine_text  of the machine file; what programs switch is on chips that record
    explicit ServedLines(const std::string& lines_text = served_map, std::uint32_t told = 7,
                         const std::string& machine_text = served_machine())
        : run_machine_(splinefeed::host::parse_machine(machine_text, "machine.toml"), true),
          chips(run_machine_.machine.lines) {
        const splinefeed::host::MachineDescription& machine = run_machine_.machine;
        auto map = std::make_unique<splinefeed::hal::gpio::LineMap>(
            splinefeed::host::parse_gpio_map(lines_text, "lines.toml", machine, "chip"));
        map_ = map.get();
        auto own_lines = std::make_unique<SimulatedLines>(*map, clock);
        lines = own_lines.get();
        lines->changed = [this] {
            carriage();
        };
        target = std::make_unique<splinefeed::host::GpioTarget>(
            std::move(map), std::move(own_lines), machine,
            splinefeed::host::RunOptions{.interrupted = &splinefeed::host::LiveMachine::gives_up}, &clock);
        switches_ = target->facts().switches;
        settings = splinefeed::host::serve_settings(run_machine_, switches_);
        motion_ = std::make_unique<splinefeed::host::ServedMotion>(machine, settings);
        served = std::make_unique<splinefeed::host::LiveMachine>(
            *target, machine,
            splinefeed::host::LiveMachine::Settings{.segment_ticks = 8000, .told = told, .clock = &clock},
            [this] { return outputs(); });
        controller = std::make_unique<splinefeed::Controller>(
            settings, motion_->motion(), *served, splinefeed::Controller::Memory{line_memory_, answer_memory_});
    }

    void send(std::string_view bytes) { controller->receive(bytes, now_ms()); }
    /// A millisecond, as the server has it.
    void tick() {
        clock.sleep_us(1000);
        controller->execute(now_ms());
        splinefeed::FeedSegment segment;
        bool more = true;
        while (served->has_room() &&
               (more = controller->next(segment, served->is_dry(), now_ms()) == splinefeed::Pull::item)) {
            served->submit(segment);
        }
        splinefeed::LineMotion& motion = motion_->motion();
        if (!more && motion.at_rest() && (motion.exhausted() || served->is_dry())) {
            served->rest();
        }
        std::array<char, 512> part{};
        while (const std::size_t size = controller->take_answers(part)) {
            text.append(part.data(), size);
        }
    }
    /// Edges of step lines so far, with their directions.
    [[nodiscard]] const splinefeed::PerAxis<std::int64_t>& counts() {
        const auto& rows = lines->rows();
        for (seen_ = std::max<std::size_t>(seen_, 1); seen_ < rows.size(); ++seen_) {
            const std::uint64_t rises = ~rows[seen_ - 1].levels & rows[seen_].levels;
            for (unsigned k = 0; k < 3; ++k) {
                const auto& motor = map_->axis[k].motor[0];
                if ((rises & motor.step.mask()) != 0) {
                    counts_[k] += (rows[seen_].levels & motor.direction.mask()) != 0 ? 1 : -1;
                    last_step_ns_ = rows[seen_].at_ns;
                }
            }
        }
        return counts_;
    }
    [[nodiscard]] std::uint64_t last_step_ns() {
        static_cast<void>(counts());
        return last_step_ns_;
    }
    /// Where the axis is in the machine, by the edges. [mm]
    [[nodiscard]] double mm(unsigned axis) { return at_start_mm[axis] + static_cast<double>(counts()[axis]) / 320.0; }
    void press(std::size_t input, bool active) {
        if (lines->active(input) != active) {
            lines->drive(input, active);
        }
    }

    VirtualClock clock;
    SimulatedLines* lines = nullptr;
    splinefeed::ControllerSettings settings;
    std::unique_ptr<splinefeed::Controller> controller;
    std::string text; // what it has said
    /// Where the axes are in truth when it is switched on, and where their switches act: below, of z above. [mm]
    std::array<double, 3> at_start_mm{};
    std::array<double, 3> switch_mm{-2.0, -2.0, 2.0};
    double plate_mm = -1000.0; ///< z of the probe's contact

    /// What the axes do to their switches.
    void carriage() {
        for (unsigned k = 0; k < 3; ++k) {
            const bool acts = k == 2 ? mm(k) >= switch_mm[k] : mm(k) <= switch_mm[k];
            if (lines->active(limit_of(k)) != acts) {
                lines->drive(limit_of(k), acts); // its line: home, too
            }
        }
        press(probe, mm(2) <= plate_mm);
    }

private:
    splinefeed::host::RunMachine run_machine_;

public:
    RecordedChips chips;
    std::unique_ptr<splinefeed::host::GpioTarget> target;
    std::unique_ptr<splinefeed::host::LiveMachine> served; // goes before what it uses

private:
    [[nodiscard]] std::unique_ptr<splinefeed::host::ProgramOutputs> outputs() {
        using namespace splinefeed::host;
        return std::make_unique<ProgramOutputs>(line_outputs(run_machine_.machine, chips.all, clock), clock);
    }
    [[nodiscard]] std::uint32_t now_ms() const { return static_cast<std::uint32_t>(clock.now_ns() / 1'000'000); }

    splinefeed::hal::gpio::LineMap* map_ = nullptr;
    splinefeed::host::SwitchFacts switches_;
    std::unique_ptr<splinefeed::host::ServedMotion> motion_;
    std::array<char, 4096> line_memory_{};
    std::array<char, 65536> answer_memory_{};
    splinefeed::PerAxis<std::int64_t> counts_{};
    std::size_t seen_ = 0;
    std::uint64_t last_step_ns_ = 0;
};

} // namespace splinefeed_test
