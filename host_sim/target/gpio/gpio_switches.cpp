// SPDX-License-Identifier: MIT
#include "host_sim/target/gpio/gpio_switches.hpp"

#include "host_sim/target/run_target.hpp"

#include "splinefeed/hal/gpio/crash_guard.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// Lines of one chip, which are safe again at the end, and if the program crashes.
class GuardedLines final : public hal::gpio::LineWriter {
public:
    explicit GuardedLines(const hal::gpio::ChipLines& chip)
        : lines_(chip.chip, "splinefeed", chip.outputs), chips_{&lines_}, guard_(chips_) {}
    [[nodiscard]] bool set(std::uint64_t mask, std::uint64_t levels) noexcept override {
        return lines_.set(mask, levels);
    }

private:
    hal::gpio::OutputLines lines_;
    std::array<hal::gpio::OutputLines*, 1> chips_;
    hal::gpio::CrashGuard guard_;
};

std::string name_of(const hal::gpio::ChipLines& chip, std::size_t bit) {
    const hal::gpio::LineName& line = chip.outputs[bit].line;
    return chip.chip + ' ' + (line.name.empty() ? "line " + std::to_string(*line.offset) : line.name);
}

} // namespace

void GpioSwitches::turn(const std::optional<SwitchedLine>& line, bool on) {
    if (!line || ended_ || !trouble_.empty()) {
        return;
    }
    const std::uint64_t mask = line->line.mask();
    if (!writers_[line->line.chip]->set(mask, on == line->on_level ? mask : 0)) {
        trouble_ = fmt::format("{} cannot be set: {}", name_of(lines_->chips[line->line.chip], line->line.bit),
                               std::strerror(errno));
    }
}

void GpioSwitches::act(EventKind kind, std::int32_t number) {
    const std::lock_guard lock(mutex_);
    const auto output = [&](bool on) {
        if (const DigitalOutput* const out = lines_->output(number)) {
            turn(out->line, on);
        }
    };
    switch (kind) {
    case EventKind::mist_on: turn(lines_->mist, true); break;
    case EventKind::flood_on: turn(lines_->flood, true); break;
    case EventKind::coolant_off:
        turn(lines_->mist, false);
        turn(lines_->flood, false);
        break;
    case EventKind::output_on_with_motion:
    case EventKind::output_on: output(true); break;
    case EventKind::output_off_with_motion:
    case EventKind::output_off: output(false); break;
    default: break;
    }
}

// A chip that fails now has failed before, or nobody is left who could do anything about it; the others go on.
void GpioSwitches::end() noexcept {
    const std::lock_guard lock(mutex_);
    if (ended_) {
        return;
    }
    ended_ = true;
    for (std::size_t c = 0; c < writers_.size(); ++c) {
        const std::vector<hal::gpio::OutputRequest>& outputs = lines_->chips[c].outputs;
        std::uint64_t mask = 0;
        std::uint64_t levels = 0;
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            mask |= std::uint64_t{1} << i;
            levels |= std::uint64_t{outputs[i].safe_level ? 1U : 0U} << i;
        }
        if (!writers_[c]->set(mask, levels) && trouble_.empty()) {
            trouble_ = fmt::format("lines of {} did not become safe: {}", lines_->chips[c].chip, std::strerror(errno));
        }
    }
}

std::string GpioSwitches::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

std::unique_ptr<RunSwitches> make_gpio_switches(const MachineDescription& machine) {
    if (machine.lines.empty()) {
        return nullptr;
    }
    GpioSwitches::Writers writers;
    try {
        for (const hal::gpio::ChipLines& chip : machine.lines.chips) {
            writers.push_back(std::make_unique<GuardedLines>(chip));
        }
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
    return std::make_unique<GpioSwitches>(machine.lines, std::move(writers));
}

} // namespace splinefeed::host
