// SPDX-License-Identifier: MIT
// In place of gpio_kind.cpp where libgpiod is not installed.
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/gpio/gpio_words.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

namespace {

[[noreturn]] void refuse() {
    throw UsageError("--target gpio://: this splinefeed was built without libgpiod; install it (Debian: libgpiod-dev) "
                     "and build again");
}

void check(const std::string& /*target*/) {
    refuse();
}

std::unique_ptr<RunTarget> make(const std::string& /*target*/, const MachineDescription& /*machine*/,
                                const RunOptions& /*options*/) {
    refuse();
}

LinkReport report(const std::string& /*target*/, const MachineDescription& /*machine*/, bool /*any_machine*/,
                  double /*seconds*/) {
    refuse();
}

} // namespace

extern const TargetKind gpio_kind{
    .names = gpio_names,
    .help = gpio_help,
    .is = is_gpio_address,
    .check = check,
    .make = make,
    .report = report,
};

} // namespace splinefeed::host
