// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/saved_modes.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

std::string text_of(Decimal value) {
    const std::int64_t size = std::abs(value.raw);
    return fmt::format("{}{}.{:09}", value.raw < 0 ? "-" : "", size / Decimal::one, size % Decimal::one);
}

std::string work_system_word(int active) {
    return active < 6 ? fmt::format("G{}", 54 + active) : fmt::format("G59.{}", active - 5);
}

// All that goes into one block, in the units that are in effect again.
std::string mode_words(const SavedModes& saved, const SavedModes& now) {
    const ModalState& to = saved.modal;
    const ModalState& from = now.modal;
    std::string out;
    const auto add = [&out](bool differs, std::string_view word) {
        if (differs) {
            out.append(word).append(" ");
        }
    };
    add(to.plane != from.plane, to.plane == Plane::xy ? "G17" : to.plane == Plane::zx ? "G18" : "G19");
    add(to.incremental != from.incremental, to.incremental ? "G91" : "G90");
    add(to.centre_absolute != from.centre_absolute, to.centre_absolute ? "G90.1" : "G91.1");
    add(to.diameter != from.diameter, to.diameter ? "G7" : "G8");
    const bool other_feed = to.inverse_time != from.inverse_time || to.per_turn != from.per_turn;
    add(other_feed, to.inverse_time ? "G93" : to.per_turn ? "G95" : "G94");
    add(to.retract_to_r != from.retract_to_r, to.retract_to_r ? "G99" : "G98");
    add(saved.offsets.active != now.offsets.active, work_system_word(saved.offsets.active));
    const bool other_path = to.path_mode != from.path_mode || to.tolerance_mm != from.tolerance_mm ||
                            to.chain_tolerance_mm != from.chain_tolerance_mm;
    add(other_path && to.path_mode == PathMode::exact_path, "G61");
    add(other_path && to.path_mode == PathMode::exact_stop, "G61.1");
    if (other_path && to.path_mode == PathMode::continuous) {
        out += fmt::format("G64 P{} Q{} ", text_of(to.in_units(to.tolerance_mm)),
                           text_of(to.in_units(to.chain_tolerance_mm)));
    }
    if (!to.inverse_time && (to.feed != from.feed || other_feed)) {
        out += fmt::format("F{} ", text_of(to.in_units(to.feed)));
    }
    return out;
}

std::string tool_words(const SavedModes& saved, const std::vector<std::string>& axes) {
    if (saved.offsets.tool == PerAxis<Decimal>{}) {
        return "G49";
    }
    std::string out = "G43.1";
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const Decimal value = saved.offsets.tool[k];
        const bool rotary = axes[k] == "a" || axes[k] == "b" || axes[k] == "c";
        out += fmt::format(" {}{}", axes[k], text_of(rotary ? value : saved.modal.in_units(value)));
    }
    return out;
}

} // namespace

std::vector<std::string> restoring_lines(const SavedModes& saved, const SavedModes& now,
                                         const std::vector<std::string>& axes) {
    std::vector<std::string> out;
    if (now.modal.cutter.side != 0 && saved.modal.cutter.side == 0) { // no other plane goes with it
        out.emplace_back("G40");
    }
    if (saved.modal.inches != now.modal.inches) { // before the lengths, in a block of its own
        out.emplace_back(saved.modal.inches ? "G20" : "G21");
    }
    if (std::string words = mode_words(saved, now); !words.empty()) {
        out.push_back(std::move(words));
    }
    if (saved.offsets.g92_applies != now.offsets.g92_applies) {
        out.emplace_back(saved.offsets.g92_applies ? "G92.3" : "G92.2");
    }
    if (saved.offsets.tool != now.offsets.tool) {
        out.push_back(tool_words(saved, axes));
    }
    const bool turns_otherwise = saved.modal.spindle != now.modal.spindle;
    const SurfaceSpeed& surface = saved.modal.surface;
    const bool other_mode = surface.applies() ? surface != now.modal.surface : now.modal.surface.applies();
    if (saved.modal.speed != now.modal.speed || turns_otherwise || other_mode) {
        const std::string_view word = !turns_otherwise                                        ? ""
                                      : saved.modal.spindle == SpindleState::clockwise        ? " M3"
                                      : saved.modal.spindle == SpindleState::counterclockwise ? " M4"
                                                                                              : " M5";
        const std::string mode = !other_mode          ? ""
                                 : !surface.applies() ? "G97 "
                                                      : fmt::format("G96 D{} ", text_of(surface.most));
        out.push_back(fmt::format("{}S{}{}", mode, text_of(saved.modal.speed), word));
    }
    CoolantState coolant = now.coolant;
    if ((coolant.mist && !saved.coolant.mist) || (coolant.flood && !saved.coolant.flood)) {
        out.emplace_back("M9");
        coolant = {};
    }
    if (saved.coolant.mist && !coolant.mist) {
        out.emplace_back("M7");
    }
    if (saved.coolant.flood && !coolant.flood) {
        out.emplace_back("M8");
    }
    return out;
}

} // namespace splinefeed::host
