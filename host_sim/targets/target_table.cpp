// SPDX-License-Identifier: MIT
#include "host_sim/targets/target_table.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/config/target_address.hpp"

#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

// Each is in a source of its own. A new one adds its name here, and in the table.
extern const TargetKind modbus_kind;
extern const TargetKind gpio_kind; // of a build without libgpiod: one that says so

namespace {

const std::array kinds{&modbus_kind, &gpio_kind};

} // namespace

std::string target_help() {
    std::string text;
    for (const TargetKind* const kind : kinds) {
        text += text.empty() ? "" : "; ";
        text += kind->help;
    }
    return text;
}

const TargetKind& target_kind(const std::string& target) {
    std::string names = "sim";
    for (const TargetKind* const kind : kinds) {
        if (kind->is(target)) {
            try {
                kind->check(target);
            } catch (const AddressError& error) {
                throw UsageError(fmt::format("--target: {}", error.what()));
            }
            return *kind;
        }
        names += kind == kinds.back() ? " and " : ", ";
        names += kind->names;
    }
    throw UsageError(fmt::format("--target {}: there is no such target; available are {}", in_quotes(target), names));
}

void check_target(const std::string& target) {
    if (target != "sim") {
        static_cast<void>(target_kind(target));
    }
}

} // namespace splinefeed::host
