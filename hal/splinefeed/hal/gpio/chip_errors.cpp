// SPDX-License-Identifier: MIT
// Error messages for chips and lines that cannot be opened or requested.
#include "splinefeed/hal/base/device_access.hpp"
#include "splinefeed/hal/gpio/chip_access.hpp"
#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include <cerrno>
#include <system_error>

namespace splinefeed::hal::gpio {

namespace {

std::string chips_here() {
    const std::string chips = devices_here({"gpiochip"});
    return chips.empty() ? "this machine has no GPIO chip (no /dev/gpiochip*)" : "this machine has " + chips;
}

std::string reason(int error) {
    return std::generic_category().message(error);
}

} // namespace

void refuse_chip(const std::string& path, int error) {
    switch (error) {
    case ENOENT: throw GpioError("there is no " + path + "; " + chips_here());
    case EACCES:
    case EPERM: throw GpioError("no permission to open " + path + ": " + who_may_open(path, "gpio", "gpio"));
    case ENOTTY:
    case EINVAL:
    case ENOTDIR:
    case ENODEV:
    case ENXIO:
    case EISDIR: throw GpioError(path + " is not a GPIO chip; " + chips_here());
    default: throw GpioError("cannot open " + path + ": " + reason(error) + "; is it a GPIO chip that is still there?");
    }
}

void refuse_lines(const ChipAccess& chip, std::span<const unsigned> offsets, const char* what, int error) {
    std::string lines;
    for (const unsigned offset : offsets) {
        const PinFacts facts = chip.facts(offset);
        if (error == EBUSY && facts.used) {
            throw GpioError(line_text(offset, facts.name) + " of " + chip.path() + " is in use by " +
                            (facts.consumer.empty() ? "an unnamed consumer" : "'" + facts.consumer + "'") +
                            "; stop that, or take another line");
        }
        lines += (lines.empty() ? "" : ", ") + line_text(offset, facts.name);
    }
    throw GpioError(lines + " of " + chip.path() + " cannot become " + what + ": " + reason(error) +
                    "; take lines that can, or another chip");
}

} // namespace splinefeed::hal::gpio
