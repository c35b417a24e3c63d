// SPDX-License-Identifier: MIT
#include "host_sim/config/drive_table.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/shipped_profiles.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

void take_defaults(DriveAddress& address, const LinkSettings& link) {
    address.link.unit = address.states_unit ? address.link.unit : link.unit;
    address.link.baud = address.states_baud ? address.link.baud : link.baud;
    address.link.parity = address.states_parity ? address.link.parity : link.parity;
    // The profile's stop bits belong to its parity; another parity has the standard's.
    if (address.link.stop_bits == 0) {
        LinkAddress standard{.parity = address.link.parity};
        address.link.stop_bits = address.link.parity == link.parity ? link.stop_bits : standard.stops();
    }
}

/// What is wrong with an address, without the place where it stands: drive_table() adds that.
template <class... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> text, Values&&... values) {
    throw AddressError(fmt::format(text, std::forward<Values>(values)...));
}

/// A drive on a serial line may stand behind a gateway; one with a socket of its own has no serial line.
void check_wire(const DriveAddress& address, const DriveProfile& profile) {
    if (address.link.wire == Wire::rtu && !profile.link.rtu) {
        refuse("the profile {} is of drives on tcp alone (`wires`); write modbus-tcp://HOST:PORT", profile.name);
    }
    if (!is_unit(address.link.wire, address.link.unit)) {
        refuse("the profile {} has the unit {}, which a serial line does not; give &unit= from 1 to {}", profile.name,
               address.link.unit, most_unit);
    }
}

/// The window becomes the profile's, which has one for the drive already or not.
void take_window(const DriveAddress& address, DriveProfile& profile) {
    if (!address.following_window_counts) {
        return;
    }
    const RegisterField* const field = profile.field_of(FieldRole::following_error_window);
    if (profile.stream != StreamWay::pvt && (field == nullptr || !field->writable())) {
        refuse(
            "the profile {} has no register for following_window; set the window in the drive, and leave the key out",
            profile.name);
    }
    if (profile.stream != StreamWay::pvt && *address.following_window_counts == 0) {
        refuse("following_window=0, no window, is known of splinefeed-pvt alone; give a number of counts");
    }
    profile.following_error_window_counts = address.following_window_counts;
}

/// What only some profiles ask for, or refuse.
void check_ramp(const DriveAddress& address, const DriveProfile& profile) {
    const bool blocks = profile.stream == StreamWay::blocks;
    if (blocks && profile.field_of(FieldRole::profile_acceleration) == nullptr && !address.ramp_counts_s2) {
        refuse("the profile {} has no register for ramps; say with &ramp= what the drive's is set to, in counts/s^2",
               profile.name);
    }
    if (!blocks && address.ramp_counts_s2) {
        refuse("the profile {} needs no ramp; leave it out", profile.name);
    }
}

class Builder {
public:
    explicit Builder(const MachineDescription& machine) : machine_(machine) {}

    void add(DriveAddress address, int machine_axis) {
        const auto k = static_cast<unsigned>(machine_axis);
        DriveProfile profile = find_profile(address.profile);
        if (profile.stream == StreamWay::speed) {
            refuse("the profile {} is of a spindle, not of an axis; name it in [spindle] of the machine file",
                   profile.name);
        }
        complete_address(address, profile);
        take_window(address, profile);
        check_ramp(address, profile);
        check_line(address);
        DriveTable::Drive& drive = drive_at(address, profile);
        const auto place = static_cast<std::size_t>(address.axis);
        if (address.axis >= profile.axes) {
            refuse("a drive with the profile {} has {}, and axis {} needs one more; name a drive for each axis in the "
                   "machine file, and run with --target modbus",
                   profile.name, profile.axes == 1 ? "one axis" : fmt::format("{} axes", profile.axes),
                   machine_.axis_name[k]);
        }
        drive.machine_axis.resize(std::max(drive.machine_axis.size(), place + 1), -1);
        if (drive.machine_axis[place] >= 0) {
            refuse("axis {} has the same drive; give this one another address, unit or &axis=",
                   machine_.axis_name[static_cast<unsigned>(drive.machine_axis[place])]);
        }
        drive.machine_axis[place] = machine_axis;
    }
    [[nodiscard]] DriveTable take() && { return std::move(table_); }

private:
    void check_line(const DriveAddress& address) const {
        for (const DriveTable::Drive& drive : table_.drives) {
            const LinkAddress& link = drive.address.link;
            if (link.same_wire(address.link) && (link.baud != address.link.baud || link.parity != address.link.parity ||
                                                 link.stops() != address.link.stops())) {
                refuse("{} has another baud rate, parity or number of stop bits for a drive before it; all on one line "
                       "have the same",
                       address.link.host);
            }
        }
    }

    DriveTable::Drive& drive_at(const DriveAddress& address, const DriveProfile& profile) {
        const bool interpolates = profile.stream == StreamWay::pvt;
        if (!table_.drives.empty() && table_.interpolate != interpolates) {
            refuse("the drives of a run must all interpolate (splinefeed-pvt) or none of them; {} and {} do not go "
                   "together",
                   table_.drives.front().profile.name, profile.name);
        }
        table_.interpolate = interpolates;
        const auto known = std::ranges::find_if(
            table_.drives, [&](const DriveTable::Drive& drive) { return drive.address.link == address.link; });
        if (known != table_.drives.end()) {
            check_same(*known, address, profile);
            return *known;
        }
        table_.drives.push_back({address, profile, {}, {}, {}, {}});
        return table_.drives.back();
    }

    // Keys of the drive as a whole, which may stand at any of its axes.
    static void check_same(DriveTable::Drive& known, const DriveAddress& address, const DriveProfile& profile) {
        auto& window = known.profile.following_error_window_counts;
        if (known.address.profile != address.profile || known.address.resample != address.resample ||
            (known.address.following_window_counts && address.following_window_counts &&
             window != profile.following_error_window_counts)) {
            refuse("{} and {} are one drive; give both the same profile, resample and following_window",
                   in_quotes(known.address.text), in_quotes(address.text));
        }
        window = address.following_window_counts ? profile.following_error_window_counts : window;
    }

    const MachineDescription& machine_;
    DriveTable table_;
};

// An address names a drive that a user typed; the others are found by their axes and lines.
void name_drive(DriveTable::Drive& drive, bool of_file, const MachineDescription& machine) {
    std::string axes;
    std::uint64_t line = 0;
    for (std::size_t i = 0; i < drive.machine_axis.size(); ++i) {
        const auto k = static_cast<unsigned>(drive.machine_axis[i]);
        const bool used = drive.machine_axis[i] >= 0;
        drive.axis_names.push_back(used ? "axis " + machine.axis_name[k] : fmt::format("its axis {}", i));
        if (used) {
            axes += (axes.empty() ? "" : " and ") + machine.axis_name[k];
            line = line == 0 ? machine.axis_line[k] : line;
        }
    }
    drive.place = of_file && !machine.file.empty() ? fmt::format("{}:{}: ", machine.file, line) : "";
    drive.name = of_file ? fmt::format("drive of {} ({})", axes, drive.address.text) : drive.address.text;
}

} // namespace

void complete_address(DriveAddress& address, const DriveProfile& profile) {
    take_defaults(address, profile.link);
    check_wire(address, profile);
}

DriveTable drive_table(const std::string& target, const MachineDescription& machine) {
    Builder builder(machine);
    for (const unsigned k : indices(machine.settings.axes)) {
        const bool of_file = target == "modbus";
        if (of_file && machine.drive[k].empty()) {
            if (machine.file.empty()) {
                throw UsageError("--target modbus takes the drives from the machine file; name it with -m");
            }
            throw InputError(machine.file, machine.axis_line[k],
                             "axis {} has no drive; add drive = \"modbus-tcp://HOST:PORT?unit=1\" to it",
                             machine.axis_name[k]);
        }
        const auto refused = [&](const std::runtime_error& error) {
            if (of_file) {
                throw InputError(machine.file, machine.axis_line[k], "drive of axis {}: {}", machine.axis_name[k],
                                 error.what());
            }
            throw UsageError("--target {}: {}", in_quotes(target), error.what());
        };
        try {
            DriveAddress address = parse_drive_address(of_file ? machine.drive[k] : target);
            if (!of_file) {
                address.axis = static_cast<int>(k);
            }
            builder.add(std::move(address), static_cast<int>(k));
        } catch (const AddressError& error) {
            refused(error);
        } catch (const UsageError& error) { // of a profile
            refused(error);
        }
    }
    DriveTable table = std::move(builder).take();
    for (DriveTable::Drive& drive : table.drives) {
        name_drive(drive, target == "modbus", machine);
    }
    return table;
}

} // namespace splinefeed::host
