// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/vfd_run_spindle.hpp"

#include "host_sim/ports/modbus/own_wire.hpp"
#include "host_sim/ports/modbus/wire_claims.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/modbus/spindle/vfd_spindle.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

class VfdRunSpindle final : public RunSpindle {
public:
    explicit VfdRunSpindle(const SpindleDescription& spindle)
        : spindle_(&spindle), claims_(spindle.vfd->address),
          vfd_({spindle.vfd->address.link, spindle.vfd->profile},
               {.at_speed_timeout_ms = static_cast<std::uint32_t>(std::lround(spindle.at_speed_timeout_s * 1e3))}) {
        if (const std::string what = vfd_.open(); !what.empty()) {
            throw TargetError(fmt::format("{}: {}", spindle.vfd->address.text, what));
        }
    }

    void order(int direction, double rpm) override { vfd_.order({direction, rpm / spindle_->rpm_per_hz}); }
    void end() override { vfd_.end(); }
    [[nodiscard]] bool reached() const override { return vfd_.reached(); }
    [[nodiscard]] bool stands() const override { return !vfd_.was_on() || vfd_.stands(); }
    [[nodiscard]] std::string trouble() const override {
        const std::string what = vfd_.trouble();
        return what.empty() ? what : fmt::format("{}: {}", spindle_->vfd->address.text, what);
    }
    [[nodiscard]] double stop_timeout_s() const override { return spindle_->at_speed_timeout_s; }

private:
    const SpindleDescription* spindle_;
    WireClaims claims_;
    VfdSpindle vfd_;
};

} // namespace

std::unique_ptr<RunSpindle> make_vfd_spindle(const MachineDescription& machine, const std::string& target) {
    require_own_wire(machine.spindle->vfd->address, "the spindle", machine, target);
    return std::make_unique<VfdRunSpindle>(*machine.spindle);
}

} // namespace splinefeed::host
