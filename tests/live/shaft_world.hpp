// SPDX-License-Identifier: MIT
// ShaftWorld: a real target in virtual time: what happens to it, and what its shafts do.
#pragma once

#include "host_sim/config/machine_file.hpp"
#include "host_sim/live/target_fit.hpp"
#include "host_sim/ports/program_outputs.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/run/run_machine.hpp"
#include "support/places.hpp"
#include "support/virtual_clock.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace splinefeed_test {

using namespace splinefeed;

/// The machine file of tests/serve: x, y, z of 320 counts a mm.
inline std::string served_machine() {
    std::ifstream file(splinefeed::test::source_folder() + "/tests/serve/machine.toml");
    return {std::istreambuf_iterator<char>(file), {}};
}

class ShaftWorld {
public:
    static constexpr double counts_per_mm = 320.0;

    /// How near to the truth it is.
    struct Nearness {
        double told_counts; ///< what is told of a place,
        double path_counts; ///< and a stop on the path;
        double stop_ms;     ///< from the request to the standstill
    };

    explicit ShaftWorld(const Nearness& nearness) : near(nearness) {}
    ShaftWorld(const ShaftWorld&) = delete;
    ShaftWorld& operator=(const ShaftWorld&) = delete;
    virtual ~ShaftWorld() = default;

    /// Facts of before that hold from its first call on.
    [[nodiscard]] virtual host::RunTarget& target() = 0;
    [[nodiscard]] std::uint32_t segment_ticks() const noexcept { return segment_ticks_; }
    [[nodiscard]] const host::RunMachine& machine() { return static_cast<void>(target()), *machine_; }
    [[nodiscard]] virtual std::unique_ptr<host::ProgramOutputs> outputs() {
        return std::make_unique<host::ProgramOutputs>(host::OutputParts(), clock);
    }
    /// Axes that stand where they are told to from the beginning, by bits.
    [[nodiscard]] virtual std::uint32_t told() const { return 7; }
    /// Throws std::invalid_argument where it does not know the fact.
    virtual void set(const std::string& fact, const std::string& value) = 0;
    virtual void clear(const std::string& fact) { throw std::invalid_argument(fact); }
    /// Where a shaft is, in the machine.
    [[nodiscard]] virtual double mm(unsigned axis) = 0;
    /// Whether drives hold the shafts.
    [[nodiscard]] virtual bool powered() { return true; }

    /// What only its stories ask.
    [[nodiscard]] virtual std::optional<std::string> answer_to(const std::string& /*word*/) { return std::nullopt; }

    /// Each millisecond; from then on it is known when a shaft has moved last.
    void look() {
        for (unsigned k = 0; k < 3; ++k) {
            const double at = mm(k);
            moved_us_ = std::fabs(at - seen_[k]) * counts_per_mm > still_counts ? clock.now_us() : moved_us_;
            seen_[k] = at;
        }
    }
    [[nodiscard]] virtual std::uint64_t moved_us() { return moved_us_; }

    VirtualClock clock;
    Nearness near;

protected:
    void take(host::MachineDescription machine) { machine_.emplace(std::move(machine), true); }
    /// The machine becomes one whose limits the target carries.
    void fit(const host::RunTarget& target) {
        segment_ticks_ = host::fit_to_target(description(), host::ScalarKind::fixed, target, true).segment_ticks;
    }
    [[nodiscard]] host::MachineDescription& description() { return machine_->machine; }
    [[nodiscard]] static unsigned axis_of(const std::string& value) { return static_cast<unsigned>(value.at(0) - 'x'); }

private:
    static constexpr double still_counts = 0.02; // a step below this is a loop's settling

    std::optional<host::RunMachine> machine_;
    std::uint32_t segment_ticks_ = 0;
    PerAxis<double> seen_{};
    std::uint64_t moved_us_ = 0;
};

} // namespace splinefeed_test
