// SPDX-License-Identifier: MIT
#include "host_sim/ports/target_table.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/drive_address.hpp"

#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace splinefeed::host {

// Each is in a source of its own. A new one adds its name here, and in the table.
extern const TargetKind sim_kind;
extern const TargetKind modbus_kind;
extern const TargetKind gpio_kind; // of a build without libgpiod: one that says so

namespace {

const std::array kinds{&sim_kind, &modbus_kind, &gpio_kind};

/// The target that a user means who names only its device or host; empty: unknown.
std::string meant_target(const std::string& target) {
    const std::size_t slashes = target.find("://");
    const std::string place = slashes == std::string::npos ? target : target.substr(slashes + 3);
    if (place.rfind("/dev/gpiochip", 0) == 0) {
        return "gpio://" + place + "?map=FILE.toml";
    }
    if (place.rfind("/dev/", 0) == 0) {
        return "modbus-rtu://" + place;
    }
    const bool host = place.find_first_of(":.") != std::string::npos && place.find_first_of("/ ") == std::string::npos;
    return host ? "modbus-tcp://" + place : std::string();
}

} // namespace

std::string target_help(bool real) {
    std::string text;
    for (const TargetKind* const kind : kinds) {
        if (kind->is_real || !real) {
            text += text.empty() ? "" : "; ";
            text += kind->help;
        }
    }
    return text;
}

const TargetKind& target_kind(const std::string& target) {
    std::vector<std::string_view> names;
    for (const TargetKind* const kind : kinds) {
        if (kind->is(target)) {
            try {
                kind->check(target);
            } catch (const AddressError& error) {
                throw UsageError("--target {}: {}", in_quotes(target), error.what());
            }
            return *kind;
        }
        names.push_back(kind->names);
    }
    const std::string_view last = names.back();
    names.pop_back();
    const std::string meant = meant_target(target);
    throw UsageError(meant.empty() ? fmt::format("--target {}: there is no such target; available are {} and {}",
                                                 in_quotes(target), fmt::join(names, ", "), last)
                                   : fmt::format("--target {}: it does not say what is there; did you mean {}?",
                                                 in_quotes(target), meant));
}

} // namespace splinefeed::host
