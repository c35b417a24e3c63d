// SPDX-License-Identifier: MIT
#include "host_sim/config/spindle_section.hpp"

#include "host_sim/config/drive_table.hpp"
#include "host_sim/config/shipped_profiles.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

SpindleDescription::Vfd read_vfd(const TomlChecker& check, const toml::node& node, double most_hz) {
    SpindleDescription::Vfd vfd;
    try {
        vfd.address = parse_drive_address(check.text(node, "vfd"));
        vfd.profile = find_profile(vfd.address.profile);
        if (vfd.profile.stream != StreamWay::speed) {
            check.fail(node, fmt::format("vfd: the profile {} is not of a frequency inverter; give &profile=, one of "
                                         "`splinefeed drive --list-profiles` that has a spindle speed",
                                         in_quotes(vfd.profile.name)));
        }
        complete_address(vfd.address, vfd.profile);
    } catch (const AddressError& error) {
        check.fail(node, fmt::format("vfd: {}", error.what()));
    } catch (const UsageError& error) {
        check.fail(node, fmt::format("vfd: {}", error.what()));
    }
    const RegisterField& speed = *vfd.profile.field_of(FieldRole::target_velocity);
    if (raw_of(speed, std::llround(most_hz * (1 << physical_bits))).clamped) {
        check.fail(node, fmt::format("max_rpm is {:g} Hz by rpm_per_hz, which the register of the profile {} cannot "
                                     "hold; lower max_rpm, or correct rpm_per_hz",
                                     most_hz, vfd.profile.name));
    }
    return vfd;
}

} // namespace

std::optional<SpindleDescription> read_spindle(const TomlChecker& check, const toml::table& root) {
    constexpr NumberRange speeds{0.001, 1e6, "1/min"};
    constexpr NumberRange ratios{0.001, 1e4, "1/min per Hz"};
    constexpr NumberRange ramps{0.0, 600.0, "s"};
    constexpr NumberRange timeouts{0.1, 600.0, "s"};
    const toml::node* const node = root.get("spindle");
    if (node == nullptr) {
        return std::nullopt;
    }
    const toml::table& table = check.table(*node, "spindle");
    check.require_known(table,
                        {"max_rpm", "min_rpm", "ramp_s", "vfd", "rpm_per_hz", "at_speed_timeout_s", "enable", "reverse",
                         "at_speed", "spin_up_s", "spin_down_s"},
                        "[spindle]");
    SpindleDescription spindle;
    const auto take = [&](std::string_view key, const NumberRange& range, double& out) {
        if (const toml::node* const given = table.get(key)) {
            out = check.number(*given, key, range);
        }
    };
    static_cast<void>(check.required(table, "max_rpm", "[spindle]", "the fastest speed that a program may ask for"));
    take("max_rpm", speeds, spindle.max_rpm);
    take("min_rpm", {0.0, spindle.max_rpm, "1/min"}, spindle.min_rpm);
    take("rpm_per_hz", ratios, spindle.rpm_per_hz);
    take("ramp_s", ramps, spindle.ramp_s);
    take("at_speed_timeout_s", timeouts, spindle.at_speed_timeout_s);
    if (const toml::node* const vfd = table.get("vfd")) {
        spindle.vfd = read_vfd(check, *vfd, spindle.max_rpm / spindle.rpm_per_hz);
    }
    return spindle;
}

} // namespace splinefeed::host
