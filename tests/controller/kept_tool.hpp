// SPDX-License-Identifier: MIT
//
// A machine in virtual time that keeps its settings in a flash: as a board does it, it begins its motion anew with
// them.
#pragma once

#include "support/ram_flash.hpp"
#include "support/virtual_machine_tool.hpp"

#include "splinefeed/base/slot.hpp"
#include "splinefeed/controller/kept_settings.hpp"

namespace splinefeed::test {

/// Settings of the firmware: it has home switches, a slow search, and no limit of the jerk.
inline ControllerSettings usual_settings() {
    ControllerSettings out = settings_of_machine_tool();
    out.homes = out.home_switches = 3;
    out.home_seek_mm_min = Decimal::from_integer(500);
    out.home_latch_mm_min = Decimal::from_integer(25);
    return out;
}

class KeptTool final : public SettingUser {
public:
    /// It is switched on.
    explicit KeptTool(LogFlash& flash) : usual(usual_settings()), machine(usual), kept(flash, usual, *this) {
        problem = kept.begin();
        motion_.emplace(kept.settings(), *stream_);
        controller.emplace(kept.settings(), *motion_, machine, Controller::Memory{lines_, answers_}, &kept);
    }

    std::string_view adopt(const ControllerSettings& settings) noexcept override {
        const auto limits = MotionLimits<double>::make(settings.machine);
        if (!limits.has_value()) {
            return describe(limits.error());
        }
        if (settings.machine.axis[0].max_jerk_mm_s3 > 0.0) {
            return "this machine has no limit of the jerk: $800 is 0";
        }
        limits_ = *limits;
        stream_.build(limits_, planner_.build(window_), rules_cast<double>(path_rules(MachineSettings{})),
                      &guard_.build(kept.settings().travel, 3));
        machine.adopt(settings);
        return {};
    }

    /// What it says to these bytes, for so long.
    std::string answer(std::string_view bytes, int ms = 300) {
        text.clear();
        controller->receive(bytes, now_);
        for (int i = 0; i < ms; ++i) {
            tick();
        }
        return text;
    }
    void tick() {
        FeedSegment segment;
        Pull pull = Pull::busy;
        while (machine.has_room() && (pull == Pull::item || pull == Pull::busy)) {
            pull = controller->next(segment, machine.is_dry(), now_);
            if (pull == Pull::item) {
                machine.submit(segment);
            }
        }
        machine.tick();
        ++now_;
        std::array<char, 512> part{};
        while (const std::size_t size = controller->take_answers(part)) {
            text.append(part.data(), size);
        }
    }

    ControllerSettings usual;
    VirtualMachineTool machine;
    KeptSettings kept;
    std::optional<Controller> controller;
    std::string text;
    std::string_view problem; // with what was kept

private:
    MotionLimits<double> limits_{};
    std::vector<PlannedCell<double>> window_ = std::vector<PlannedCell<double>>(256);
    Slot<AccelerationPlanner<double>> planner_;
    Slot<TravelGuard<double>> guard_;
    Slot<ScalarStream<double>> stream_;
    std::optional<LineMotion> motion_;
    std::array<char, 4096> lines_{};
    std::array<char, 16384> answers_{};
    std::uint32_t now_ = 1000;
};

/// The value of a line like $100=320.000 in what a machine says.
inline std::string value_of(const std::string& text, const std::string& name) {
    const std::size_t at = text.find(name + "=");
    return at == std::string::npos ? "none"
                                   : text.substr(at + name.size() + 1, text.find("\r\n", at) - at - name.size() - 1);
}

} // namespace splinefeed::test
