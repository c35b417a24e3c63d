// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"
#include "host_sim/ports/gpio/gpio_link.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "host_sim/ports/gpio/gpio_words.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

namespace {

void check_gpio(const std::string& target) {
    static_cast<void>(parse_gpio_address(target));
}

std::unique_ptr<RunTarget> make_gpio(const std::string& target, const MachineDescription& machine,
                                     const RunOptions& options) {
    return make_gpio_target(parse_gpio_address(target), machine, options);
}

LinkReport gpio_link_report(const std::string& target, const MachineDescription& machine, bool /*any_machine*/,
                            double seconds) {
    return {gpio_report(parse_gpio_address(target), machine, seconds), {}};
}

} // namespace

extern const TargetKind gpio_kind{
    .names = gpio_names,
    .help = gpio_help,
    .is = is_gpio_address,
    .check = check_gpio,
    .make = make_gpio,
    .report = gpio_link_report,
};

} // namespace splinefeed::host
