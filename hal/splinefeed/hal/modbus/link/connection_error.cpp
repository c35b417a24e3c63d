// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/connection_error.hpp"

#include "splinefeed/hal/base/device_access.hpp"

#include <array>
#include <cerrno>
#include <modbus/modbus.h>

namespace splinefeed::hal::modbus {

namespace {

struct Advice {
    Wire wire;
    int error;
    const char* text;
};

constexpr const char* no_serial_device = "that is no serial device; name one like /dev/ttyUSB0";
constexpr const char* no_route = "check the address, and this computer's network";
constexpr const char* unplugged = "the adapter was unplugged; plug it in, and begin again";

constexpr std::array advices{
    Advice{Wire::tcp, ECONNREFUSED, "check the port, and whether Modbus TCP is turned on in the drive"},
    Advice{Wire::tcp, ETIMEDOUT, "check address, power and cable"},
    Advice{Wire::tcp, EHOSTUNREACH, no_route},
    Advice{Wire::tcp, ENETUNREACH, no_route},
    Advice{Wire::tcp, ENETDOWN, no_route},
    Advice{Wire::tcp, ECONNRESET, "the drive or another program has taken the connection; has the drive only one?"},
    Advice{Wire::rtu, EBUSY, "another program uses the device; end it (fuser -v names it)"},
    Advice{Wire::rtu, ENOTTY, no_serial_device},
    Advice{Wire::rtu, EINVAL, no_serial_device},
    Advice{Wire::rtu, EISDIR, no_serial_device},
    Advice{Wire::rtu, ENOTDIR, no_serial_device},
    Advice{Wire::rtu, ENXIO, unplugged},
    Advice{Wire::rtu, ENODEV, unplugged},
    Advice{Wire::rtu, EIO, unplugged},
};

std::string advice_on(int error, const LinkAddress& address) {
    if (address.wire == Wire::rtu && (error == EACCES || error == EPERM)) {
        return who_may_open(address.host, "tty", "dialout");
    }
    if (address.wire == Wire::rtu && error == ENOENT) {
        const std::string devices = devices_here({"ttyUSB", "ttyACM"});
        return "is the adapter plugged in? this machine has " +
               (devices.empty() ? "no /dev/ttyUSB* or /dev/ttyACM*" : devices);
    }
    for (const Advice& advice : advices) {
        if (advice.wire == address.wire && advice.error == error) {
            return advice.text;
        }
    }
    return address.wire == Wire::tcp ? "check host, port and cable" : "check device and cable";
}

} // namespace

std::string connection_error(int error, const LinkAddress& address) {
    if (error == no_such_host) {
        return "no host has the name " + address.host + "; check it, or write an IPv4 address";
    }
    return modbus_strerror(error) + ("; " + advice_on(error, address));
}

} // namespace splinefeed::hal::modbus
