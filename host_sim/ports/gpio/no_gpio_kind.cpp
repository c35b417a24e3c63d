// SPDX-License-Identifier: MIT
// In place of gpio_kind.cpp where libgpiod is not installed.
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/gpio/gpio_words.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

extern const TargetKind gpio_kind{
    .names = gpio_names,
    .help = gpio_help,
    .is = is_gpio_address,
    .check =
        [](const std::string& /*target*/) {
            throw UsageError("--target gpio://: this splinefeed was built without libgpiod; install it (Debian: "
                             "libgpiod-dev) and build again");
        },
    .make = nullptr, // nobody comes so far
    .report = nullptr,
};

} // namespace splinefeed::host
