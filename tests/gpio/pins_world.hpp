// SPDX-License-Identifier: MIT
// PinsWorld: a machine on simulated step lines, with a switch at the end of each axis, which is limit and home.
#pragma once

#include "host_sim/config/gpio_map.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "host_sim/ports/gpio/pin_outputs.hpp"
#include "live/shaft_world.hpp"
#include "recorded_chips.hpp"
#include "simulated_pins.hpp"

#include <sstream>

namespace splinefeed_test {

class PinsWorld final : public ShaftWorld {
public:
    PinsWorld() : ShaftWorld({.told_counts = 0.5, .path_counts = 1.0, .stop_ms = 220}) {}

    [[nodiscard]] host::RunTarget& target() override {
        if (!target_) {
            std::string text = served_machine();
            if (switches_outputs_) {
                text.replace(text.find("[spindle]\n"), 10,
                             "[spindle]\nenable = { line = \"SPINDLE\" }\nspin_up_s = 0.3\n");
            }
            take(host::parse_machine(text + (switches_outputs_ ? outputs_text : ""), "machine.toml"));
            chips.emplace(description().lines);
            auto map = std::make_unique<hal::gpio::PinMap>(
                host::parse_gpio_map(map_text(), "lines.toml", description(), "chip"));
            map_ = map.get();
            auto own_lines = std::make_unique<SimulatedPins>(*map, clock);
            lines = own_lines.get();
            lines->changed = [this] {
                carriage();
            };
            target_ = std::make_unique<host::GpioTarget>(std::move(map), std::move(own_lines), description(),
                                                         host::RunOptions{.interrupted = &host::LiveMachine::gives_up},
                                                         &clock);
            fit(*target_);
            carriage();
        }
        return *target_;
    }
    [[nodiscard]] std::unique_ptr<host::ProgramOutputs> outputs() override {
        return std::make_unique<host::ProgramOutputs>(host::pin_outputs(description(), chips->all, clock), clock);
    }
    [[nodiscard]] std::uint32_t told() const override { return told_; }
    /// told BITS, starts X Y Z, lacks home y, lacks switches, outputs: before it begins. limit x, gone z: its switch
    /// acts wherever it is, or nowhere. plate Z, of the probe. limit-level x, e-stop-level: it tells no edge. e-stop,
    /// fault, broken.
    void set(const std::string& fact, const std::string& value) override {
        std::istringstream words(value);
        fact == "told"           ? void(near.told_counts = (words >> told_, told_ == 7 ? 0.5 : edge_counts))
        : fact == "starts"       ? void(words >> start_mm_[0] >> start_mm_[1] >> start_mm_[2])
        : fact == "lacks"        ? void(lacks_ = value)
        : fact == "outputs"      ? void(switches_outputs_ = true)
        : fact == "limit"        ? place(axis_of(value), true)
        : fact == "limit-level"  ? place(axis_of(value), true, false)
        : fact == "e-stop-level" ? press("e-stop", true, false)
        : fact == "gone"         ? place(axis_of(value), false)
                                 : fact == "plate"
            ? void(words >> plate_mm_),
            carriage()
            : fact == "broken" ? lines->fail(true)
          : fact == "ready"    ? void(chips->inputs.at(0)->now = 1)
                               : press(fact, true);
    }
    void clear(const std::string& fact) override {
        if (fact == "limit") {
            switch_mm_ = at_ends;
            carriage();
        } else {
            press(fact, false);
        }
    }
    /// levels: how often they were set, and those that are set now.
    [[nodiscard]] std::optional<std::string> answer_to(const std::string& word) override {
        return word == "levels" ? std::optional(levels()) : std::nullopt;
    }
    [[nodiscard]] double mm(unsigned axis) override {
        return start_mm_[axis] + static_cast<double>(counts()[axis]) / counts_per_mm;
    }
    [[nodiscard]] std::uint64_t moved_us() override { return static_cast<void>(counts()), last_step_ns_ / 1000; }
    [[nodiscard]] bool powered() override { return lines->enabled(); }
    /// Edges of step lines so far, with their directions.
    [[nodiscard]] const PerAxis<std::int64_t>& counts() {
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

    SimulatedPins* lines = nullptr;
    std::optional<RecordedChips> chips; ///< of what programs switch

private:
    static constexpr double edge_counts = 2.6; // a switch's edge is a step
    static constexpr const char* outputs_text =
        "[lines]\nchip = \"/dev/gpiochip1\"\n[coolant.flood]\nline = \"FLOOD\"\n[[output]]\nnumber = 3\n"
        "line = \"CLAMP\"\n[[input]]\nnumber = 2\nline = \"READY\"\n";
    static constexpr std::array<double, 3> at_ends{-2.0, -2.0, 2.0};

    [[nodiscard]] std::string map_text() const {
        std::string text = "[enable]\nline = 6\nsettle_ms = 5\n";
        const auto add_input = [&text](const std::string& role, const std::string& axis, int line) {
            text += "[[input]]\nrole = \"" + role + "\"\n" + axis + "line = " + std::to_string(line) + "\n";
        };
        for (const char axis : {'x', 'y', 'z'}) {
            const int k = axis - 'x';
            const std::string axis_key = std::string("axis = \"") + axis + "\"\n";
            text += std::string("[axis.") + axis + "]\nstep = " + std::to_string(2 * k) +
                    "\ndirection = " + std::to_string(2 * k + 1) + "\n";
            if (lacks_ != "switches" && lacks_ != std::string("home ") + axis) {
                text +=
                    std::string("[home.") + axis + "]\nseek_mm_s = 50\nlatch_mm_s = 5\npull_off_mm = 2\n" +
                    (axis == 'z' ? "towards = \"high\"\nposition_mm = 2\n" : "towards = \"low\"\nposition_mm = -2\n");
                add_input("home", axis_key, 10 + k);
            }
            add_input("limit", axis_key, 10 + k);
        }
        add_input("e-stop", "", 20);
        add_input("drive-fault", "", 21);
        lacks_ == "switches" ? void() : add_input("probe", "", 22);
        return text;
    }
    [[nodiscard]] std::string levels() const {
        const auto& rows = chips->chip.at(0)->rows();
        return fmt::format("{} {}", rows.size(), rows.empty() ? 0 : rows.back().levels);
    }
    void place(unsigned axis, bool acts, bool with_edge = true) {
        switch_mm_[axis] = (axis == 2) == acts ? -1000.0 : 1000.0;
        carriage(with_edge);
    }
    void press(const std::string& role, bool active, bool with_edge = true) {
        static_cast<void>(target());
        const auto wanted = role == "fault"    ? hal::gpio::InputRole::drive_fault
                            : role == "e-stop" ? hal::gpio::InputRole::e_stop
                            : role == "probe"  ? hal::gpio::InputRole::probe
                                               : throw std::invalid_argument(role);
        for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
            if (map_->inputs[i].role == wanted && lines->active(i) != active) {
                lines->drive(i, active, with_edge);
            }
        }
    }
    /// What the axes do to their switches.
    void carriage(bool with_edge = true) {
        for (std::size_t i = 0; lines != nullptr && i < map_->inputs.size(); ++i) {
            const auto& input = map_->inputs[i];
            const unsigned k = static_cast<unsigned>(std::max(input.axis, 0));
            const bool acts = k == 2 ? mm(k) >= switch_mm_[k] : mm(k) <= switch_mm_[k];
            if (input.role == hal::gpio::InputRole::limit && lines->active(i) != acts) {
                lines->drive(i, acts, with_edge); // its line: home, too
            }
        }
        lines != nullptr ? press("probe", mm(2) <= plate_mm_) : void();
    }

    bool switches_outputs_ = false;
    std::string lacks_;
    std::uint32_t told_ = 7;
    std::array<double, 3> start_mm_{};
    std::array<double, 3> switch_mm_ = at_ends;
    double plate_mm_ = -1000.0;
    hal::gpio::PinMap* map_ = nullptr;
    PerAxis<std::int64_t> counts_{};
    std::size_t seen_ = 0;
    std::uint64_t last_step_ns_ = 0;
    std::unique_ptr<host::GpioTarget> target_;
};

} // namespace splinefeed_test
