// SPDX-License-Identifier: MIT
// SimWorld: the simulated machine.
#pragma once

#include "host_sim/live/live_machine.hpp"
#include "host_sim/ports/sim/sim_target.hpp"
#include "live/shaft_world.hpp"

namespace splinefeed_test {

class SimWorld final : public ShaftWorld {
public:
    SimWorld() : ShaftWorld({.told_counts = 1e-6, .path_counts = 1.0, .stop_ms = 150}) {
        take(host::parse_machine(served_machine(), "machine.toml"));
    }
    [[nodiscard]] host::RunTarget& target() override {
        if (!target_) {
            target_.emplace(description(), host::RunOptions{.interrupted = &host::LiveMachine::gives_up}, clock);
            fit(*target_);
        }
        return *target_;
    }
    [[nodiscard]] std::unique_ptr<host::ProgramOutputs> outputs() override {
        host::OutputParts parts{std::make_shared<host::SimSpindle>(*description().spindle, clock)};
        return std::make_unique<host::ProgramOutputs>(std::move(parts), clock);
    }
    void set(const std::string& fact, const std::string& /*value*/) override { throw std::invalid_argument(fact); }
    [[nodiscard]] double mm(unsigned axis) override {
        const auto places = target().places();
        return places.empty() ? 0.0 : places[axis].mm.value();
    }

private:
    std::optional<host::SimTarget> target_;
};

} // namespace splinefeed_test
