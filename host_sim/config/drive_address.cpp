// SPDX-License-Identifier: MIT
#include "host_sim/config/drive_address.hpp"

#include "host_sim/base/address_text.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/config/baud_rate.hpp"

#include "splinefeed/base/capacity.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

int whole_number(std::string_view key, std::string_view value, int low, int high) {
    const auto number = read_whole(value, low, high);
    if (!number) {
        throw AddressError("{} is {}; it must be a whole number from {} to {}", key, in_quotes(value), low, high);
    }
    return *number;
}

void take_baud(DriveAddress& address, std::string_view value) {
    address.link.baud = whole_number("baud", value, baud_rates.front(), baud_rates.back());
    address.states_baud = true;
    if (!is_baud_rate(address.link.baud)) {
        throw AddressError("baud is {}; it must be one of {}", value, fmt::join(baud_rates, ", "));
    }
}

double ramp(std::string_view value) {
    constexpr double least = 1.0;
    constexpr double most = 1e12;
    double number = 0.0;
    if (read_number(value, number) != NumberText::number || number < least || number > most) {
        throw AddressError("ramp is {}; it must be a number of counts/s^2 from 1 to 1e12", in_quotes(value));
    }
    return number;
}

int unit_number(std::string_view value, hal::modbus::Wire wire) {
    using namespace hal::modbus;
    const bool single = wire == Wire::tcp && value == std::to_string(single_unit);
    try {
        return single ? single_unit : whole_number("unit", value, 1, most_unit);
    } catch (const AddressError& error) {
        throw AddressError(std::string(error.what()) +
                           (wire == Wire::tcp ? ", or 255, the device at that address itself" : ""));
    }
}

void take_key(DriveAddress& address, std::string_view key, std::string_view value) {
    constexpr std::array<std::string_view, 9> serial{"profile",          "unit", "axis",   "resample", "ramp",
                                                     "following_window", "baud", "parity", "stop"};
    constexpr std::size_t serial_only = 3;
    constexpr int most_window = 0x7FFFFFFF;
    const bool line = address.link.wire == hal::modbus::Wire::rtu;
    if (key == "profile") {
        address.profile = value;
    } else if (key == "unit") {
        address.link.unit = unit_number(value, address.link.wire);
        address.states_unit = true;
    } else if (key == "ramp") {
        address.ramp_counts_s2 = ramp(value);
    } else if (key == "following_window") {
        address.following_window_counts = whole_number(key, value, 0, most_window);
    } else if (key == "axis") {
        address.axis = whole_number(key, value, 0, max_axes - 1);
    } else if (key == "resample" && (value == "yes" || value == "no")) {
        address.resample = value == "yes";
    } else if (key == "resample") {
        throw AddressError("resample is {}; it must be yes or no", in_quotes(value));
    } else if (key == "baud" && line) {
        take_baud(address, value);
    } else if (key == "parity" && line) {
        if (value != "N" && value != "E" && value != "O") {
            throw AddressError("parity is {}; it must be N, E or O", in_quotes(value));
        }
        address.link.parity = value.front();
        address.states_parity = true;
    } else if (key == "stop" && line) {
        address.link.stop_bits = whole_number(key, value, 1, 2);
    } else {
        const std::size_t known = line ? serial.size() : serial.size() - serial_only;
        if (std::ranges::find(serial, key) != serial.end()) {
            throw AddressError("{} is of serial lines; leave it out", key);
        }
        throw AddressError("unknown key {}{}", in_quotes(key), suggestion(key, {serial.data(), known}));
    }
}

void take_place(DriveAddress& address, std::string_view place) {
    if (place.empty()) {
        throw AddressError(address.link.wire == hal::modbus::Wire::rtu
                               ? "there is no device; write modbus-rtu:///dev/ttyUSB0?baud=115200"
                               : "there is no host; write modbus-tcp://192.168.0.10:502");
    }
    if (address.link.wire == hal::modbus::Wire::rtu) {
        address.link.host = place;
        return;
    }
    const std::size_t colon = place.find(':');
    if (place.find(':', colon == std::string_view::npos ? colon : colon + 1) != std::string_view::npos &&
        colon != std::string_view::npos) {
        throw AddressError("more than one ':' in the host; give a name or an IPv4 address, then :PORT");
    }
    address.link.host = place.substr(0, colon);
    if (colon != std::string_view::npos) {
        constexpr int most_port = 65535;
        address.link.port = whole_number("port", place.substr(colon + 1), 1, most_port);
    }
}

} // namespace

DriveAddress parse_drive_address(const std::string& text) {
    DriveAddress address;
    address.text = text;
    const AddressText parts = split_address(text);
    if (parts.scheme == "modbus-rtu") {
        address.link.wire = hal::modbus::Wire::rtu;
    } else if (parts.scheme != "modbus-tcp") {
        throw AddressError("{} is no address of a drive; write modbus-tcp://HOST:PORT or "
                           "modbus-rtu:///dev/ttyUSB0?baud=115200",
                           in_quotes(text));
    }
    take_place(address, parts.place);
    for (const AddressText::Setting& setting : parts.settings) {
        if (setting.value.empty()) {
            throw AddressError("{} has no value; write key=value, with & between two", in_quotes(setting.text));
        }
        take_key(address, setting.key, setting.value);
    }
    return address;
}

} // namespace splinefeed::host
