// SPDX-License-Identifier: MIT
#include "host_sim/config/spindle_section.hpp"

#include "host_sim/config/drive_table.hpp"
#include "host_sim/config/machine_keys.hpp"
#include "host_sim/config/shipped_profiles.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <cmath>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

SpindleDescription::Vfd read_vfd(const TomlChecker& check, const toml::node& node, double most_hz) {
    SpindleDescription::Vfd vfd;
    try {
        vfd.address = parse_drive_address(check.text(node, "vfd"));
        vfd.profile = find_profile(vfd.address.profile);
        if (vfd.profile.stream != StreamWay::speed) {
            check.fail(node,
                       "vfd: the profile {} is not of a frequency inverter; give &profile=, one of "
                       "`splinefeed drive --list-profiles` that has a spindle speed",
                       in_quotes(vfd.profile.name));
        }
        complete_address(vfd.address, vfd.profile);
    } catch (const AddressError& error) {
        check.fail(node, "vfd: {}", error.what());
    } catch (const UsageError& error) {
        check.fail(node, "vfd: {}", error.what());
    }
    const RegisterField& speed = *vfd.profile.field_of(FieldRole::target_velocity);
    if (raw_of(speed, std::llround(most_hz * (1 << physical_bits))).clamped) {
        check.fail(node,
                   "max_rpm is {:g} Hz by rpm_per_hz, which the register of the profile {} cannot "
                   "hold; lower max_rpm, or correct rpm_per_hz",
                   most_hz, vfd.profile.name);
    }
    return vfd;
}

} // namespace

std::optional<SpindleDescription> read_spindle(const TomlChecker& check, const toml::table& root) {
    const toml::table* const part = check.part(root, spindle_table, "spindle");
    if (part == nullptr) {
        return std::nullopt;
    }
    const toml::table& table = *part;
    SpindleDescription spindle;
    check.attempt([&] {
        static_cast<void>(
            check.required(table, "max_rpm", "[spindle]", "the fastest speed that a program may ask for"));
        check.take(table, spindle_table, "max_rpm", spindle.max_rpm);
    });
    check.attempt([&] {
        if (const toml::node* const least = table.get("min_rpm")) {
            const FileKey& row = spindle_table.row("min_rpm");
            const double most = spindle.max_rpm > 0.0 ? spindle.max_rpm : row.high; // max_rpm itself may be wrong
            spindle.min_rpm = check.number(*least, row.key, {row.low, most, row.unit});
        }
    });
    check.attempt([&] { check.take(table, spindle_table, "rpm_per_hz", spindle.rpm_per_hz); });
    check.attempt([&] { check.take(table, spindle_table, "ramp_s", spindle.ramp_s); });
    check.attempt([&] { check.take(table, spindle_table, "at_speed_timeout_s", spindle.at_speed_timeout_s); });
    check.attempt([&] {
        if (const toml::node* const vfd = table.get("vfd")) {
            spindle.vfd = read_vfd(check, *vfd, spindle.max_rpm / spindle.rpm_per_hz);
        }
    });
    return spindle;
}

} // namespace splinefeed::host
