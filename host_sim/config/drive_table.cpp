// SPDX-License-Identifier: MIT
#include "host_sim/config/drive_table.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/shipped_profiles.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

TargetAddress address_of(const std::string& text) {
    try {
        return parse_target_address(text);
    } catch (const AddressError& error) {
        throw UsageError(fmt::format("--target {}: {}", in_quotes(text), error.what()));
    }
}

void take_defaults(TargetAddress& address, const LinkSettings& link) {
    address.link.unit = address.states_unit ? address.link.unit : link.unit;
    address.link.baud = address.states_baud ? address.link.baud : link.baud;
    address.link.parity = address.states_parity ? address.link.parity : link.parity;
    // The profile's stop bits belong to its parity; another parity has the standard's.
    if (address.link.stop_bits == 0) {
        LinkAddress standard{.parity = address.link.parity};
        address.link.stop_bits = address.link.parity == link.parity ? link.stop_bits : standard.stops();
    }
}

/// A drive on a serial line may stand behind a gateway; one with a socket of its own has no serial line.
void check_wire(const TargetAddress& address, const DriveProfile& profile) {
    if (address.link.wire == Wire::rtu && !profile.link.rtu) {
        throw UsageError(fmt::format("--target {}: the profile {} is of drives on tcp alone (`wires`); write "
                                     "modbus-tcp://HOST:PORT",
                                     in_quotes(address.text), profile.name));
    }
    if (!is_unit(address.link.wire, address.link.unit)) {
        throw UsageError(fmt::format("--target {}: the profile {} has the unit {}, which a serial line does not; give "
                                     "&unit= from 1 to {}",
                                     in_quotes(address.text), profile.name, address.link.unit, most_unit));
    }
}

/// The window becomes the profile's, which has one for the drive already or not.
void take_window(const TargetAddress& address, DriveProfile& profile) {
    if (!address.following_window_counts) {
        return;
    }
    const RegisterField* const field = profile.field_of(FieldRole::following_error_window);
    if (profile.stream != StreamWay::pvt && (field == nullptr || !field->writable())) {
        throw UsageError(fmt::format("--target {}: the profile {} has no register for following_window; set the window "
                                     "in the drive, and leave the key out",
                                     in_quotes(address.text), profile.name));
    }
    if (profile.stream != StreamWay::pvt && *address.following_window_counts == 0) {
        throw UsageError(fmt::format("--target {}: following_window=0, no window, is known of splinefeed-pvt alone; "
                                     "give a number of counts",
                                     in_quotes(address.text)));
    }
    profile.following_error_window_counts = address.following_window_counts;
}

/// What only some profiles ask for, or refuse.
void check_ramp(const TargetAddress& address, const DriveProfile& profile) {
    const bool blocks = profile.stream == StreamWay::blocks;
    if (blocks && profile.field_of(FieldRole::profile_acceleration) == nullptr && !address.ramp_counts_s2) {
        throw UsageError(fmt::format("--target {}: the profile {} has no register for ramps; say with &ramp= what the "
                                     "drive's is set to, in counts/s^2",
                                     in_quotes(address.text), profile.name));
    }
    if (!blocks && address.ramp_counts_s2) {
        throw UsageError(fmt::format("--target {}: the profile {} needs no ramp; leave it out", in_quotes(address.text),
                                     profile.name));
    }
}

class Builder {
public:
    explicit Builder(const MachineDescription& machine) : machine_(machine) {}

    void add(TargetAddress address, int machine_axis) {
        const auto k = static_cast<unsigned>(machine_axis);
        DriveProfile profile = find_profile(address.profile);
        if (profile.stream == StreamWay::speed) {
            throw UsageError(fmt::format("--target {}: the profile {} is of a spindle, not of an axis; name it in "
                                         "[spindle] of the machine file",
                                         in_quotes(address.text), profile.name));
        }
        complete_address(address, profile);
        take_window(address, profile);
        check_ramp(address, profile);
        check_line(address, machine_.axis_name[k]);
        DriveTable::Drive& drive = drive_at(address, profile);
        const auto place = static_cast<std::size_t>(address.axis);
        if (address.axis >= profile.axes) {
            throw UsageError(
                fmt::format("--target {}: axis {} of a drive with the profile {}, which has {}; each axis "
                            "needs a drive of its own then, named in the machine file, with --target modbus",
                            in_quotes(address.text), address.axis, profile.name,
                            profile.axes == 1 ? "one" : fmt::format("{}", profile.axes)));
        }
        drive.machine_axis.resize(std::max(drive.machine_axis.size(), place + 1), -1);
        if (drive.machine_axis[place] >= 0) {
            throw UsageError(fmt::format("--target modbus: the drive of axis {} is that of another axis, too; name "
                                         "another address, unit or &axis= in the machine file",
                                         machine_.axis_name[k]));
        }
        drive.machine_axis[place] = machine_axis;
    }
    [[nodiscard]] DriveTable take() && { return std::move(table_); }

private:
    void check_line(const TargetAddress& address, const std::string& axis) const {
        for (const DriveTable::Drive& drive : table_.drives) {
            const LinkAddress& link = drive.address.link;
            if (link.same_wire(address.link) && (link.baud != address.link.baud || link.parity != address.link.parity ||
                                                 link.stops() != address.link.stops())) {
                throw UsageError(fmt::format("--target modbus: the drive of axis {} is on {} with another baud rate, "
                                             "parity or number of stop bits than a drive before it; all on one line "
                                             "have the same",
                                             axis, address.link.host));
            }
        }
    }

    DriveTable::Drive& drive_at(const TargetAddress& address, const DriveProfile& profile) {
        const bool interpolates = profile.stream == StreamWay::pvt;
        if (!table_.drives.empty() && table_.interpolate != interpolates) {
            throw UsageError(
                fmt::format("--target modbus: the drives of a run must all interpolate (splinefeed-pvt) or "
                            "none of them; {} and {} do not go together",
                            table_.drives.front().profile.name, profile.name));
        }
        table_.interpolate = interpolates;
        const auto known =
            std::find_if(table_.drives.begin(), table_.drives.end(),
                         [&](const DriveTable::Drive& drive) { return drive.address.link == address.link; });
        if (known != table_.drives.end()) {
            check_same(*known, address, profile);
            return *known;
        }
        table_.drives.push_back({address, profile, {}});
        return table_.drives.back();
    }

    // Keys of the drive as a whole, which may stand at any of its axes.
    static void check_same(DriveTable::Drive& known, const TargetAddress& address, const DriveProfile& profile) {
        auto& window = known.profile.following_error_window_counts;
        if (known.address.profile != address.profile || known.address.resample != address.resample ||
            (known.address.following_window_counts && address.following_window_counts &&
             window != profile.following_error_window_counts)) {
            throw UsageError(fmt::format("--target modbus: {} and {} are one drive; give both the same profile, "
                                         "resample and following_window",
                                         in_quotes(known.address.text), in_quotes(address.text)));
        }
        window = address.following_window_counts ? profile.following_error_window_counts : window;
    }

    const MachineDescription& machine_;
    DriveTable table_;
};

} // namespace

void complete_address(TargetAddress& address, const DriveProfile& profile) {
    take_defaults(address, profile.link);
    check_wire(address, profile);
}

DriveTable drive_table(const std::string& target, const MachineDescription& machine) {
    Builder builder(machine);
    for (int k = 0; k < machine.settings.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        if (target == "modbus" && machine.drive[axis].empty()) {
            throw UsageError(fmt::format("--target modbus: axis {} has no drive; add drive = "
                                         "\"modbus-tcp://HOST:PORT?unit=1\" to it in the machine file",
                                         machine.axis_name[axis]));
        }
        TargetAddress address = address_of(target == "modbus" ? machine.drive[axis] : target);
        if (target != "modbus") {
            address.axis = k;
        }
        builder.add(std::move(address), k);
    }
    return std::move(builder).take();
}

} // namespace splinefeed::host
