// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/pin_claims.hpp"

#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace splinefeed::host {

PinClaims::PinClaims(const hal::gpio::ChipPins& chip) {
    std::error_code none;
    const std::string found = hal::gpio::find_chip(chip.chip);
    const std::filesystem::path device = std::filesystem::canonical(found, none); // it may be a link
    const std::string path = none ? found : device.string();
    for (const hal::gpio::OutputRequest& output : chip.outputs) {
        add(path, output.line);
    }
    for (const hal::gpio::InputRequest& input : chip.inputs) {
        add(path, input.line);
    }
}

void PinClaims::add(const std::string& chip, const hal::gpio::PinName& line) {
    const std::string name = line.name.empty() ? fmt::format("line {}", line.offset.value_or(0)) : line.name;
    const ResourceClaim& claim = claims_.emplace_back("gpio:" + chip + "/" + name);
    if (!claim.holder().empty()) {
        throw hal::gpio::GpioError(fmt::format("{} of {}: {} uses it; end that first", name, chip, claim.holder()));
    }
}

} // namespace splinefeed::host
