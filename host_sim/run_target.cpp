// SPDX-License-Identifier: MIT
#include "run_target.hpp"

#include "input_error.hpp"
#include "pvt_target.hpp"
#include "setpoint_target.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#ifdef SPLINEFEED_HAS_GPIO
#include "gpio/gpio_target.hpp"
#endif

namespace splinefeed::host {

namespace {

using hal::modbus::monotonic_us;
using hal::modbus::sleep_until_us;

constexpr std::uint64_t poll_every_us = 1000;

std::atomic<int> interrupts{0};
std::atomic<UserSteering> steering{UserSteering::none};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<UserSteering>::is_always_lock_free);

extern "C" void take_interrupt(int /*signal*/) {
    interrupts.fetch_add(1);
}
extern "C" void take_steering_signal(int signal) {
    steering.store(signal == SIGUSR1 ? UserSteering::hold : UserSteering::resume);
}

} // namespace

RunTarget::RunTarget() {
    interrupts.store(0);
    steering.store(UserSteering::none);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        static_cast<void>(std::signal(signal, take_interrupt));
    }
    for (const int signal : {SIGUSR1, SIGUSR2}) {
        static_cast<void>(std::signal(signal, take_steering_signal));
    }
}

UserSteering RunTarget::take_steering() {
    return steering.exchange(UserSteering::none);
}

bool RunTarget::interrupted() {
    return interrupts.load() > 0;
}

RunTarget::~RunTarget() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) {
        static_cast<void>(std::signal(signal, SIG_DFL));
    }
}

// False: the run is over.
bool RunTarget::poll() {
    // The first time on the path, the second time at once.
    const int asked = interrupts.load();
    if (asked > 0 && halts_ == 0) {
        hold();
    } else if (asked > 1 && halts_ == 1) {
        quick_stop();
    }
    halts_ = std::min(asked, 2);
    look();
    phase_ = port().poll().phase;
    switch (phase_) {
    case hal::PortPhase::fault: why_ = fault(); return false;
    case hal::PortPhase::halted:
        why_ = halts_ > 1 ? "interrupted twice: all axes stopped, each for itself"
                          : "interrupted: all drives were held on the path";
        return false;
    case hal::PortPhase::idle:
    case hal::PortPhase::running: break;
    }
    return true;
}

bool RunTarget::submit(const FeedSegment& segment) {
    if (!prepared_) {
        prepared_ = true;
        why_ = prepare(segment);
        if (!why_.empty()) {
            return false;
        }
    }
    if (!poll()) {
        return false;
    }
    while (port().room() == 0) {
        sleep_until_us(monotonic_us() + poll_every_us);
        if (!poll()) {
            return false;
        }
    }
    return port().submit(segment);
}

bool RunTarget::finish() {
    if (!prepared_ || !why_.empty()) {
        return why_.empty();
    }
    complete();
    while (poll()) {
        if (phase_ == hal::PortPhase::idle) {
            return true;
        }
        sleep_until_us(monotonic_us() + poll_every_us);
    }
    return false;
}

std::unique_ptr<RunTarget> make_run_target(const std::string& target, const MachineDescription& machine,
                                           const RunWishes& wishes) {
#ifdef SPLINEFEED_HAS_GPIO
    if (is_gpio_address(target)) {
        return std::make_unique<GpioTarget>(parse_gpio_address(target), machine, wishes);
    }
#endif
    if (wishes.probe) {
        throw UsageError("--probe needs a probe: an input of a target gpio://");
    }
    DriveTable table = drive_table(target, machine);
    if (table.interpolate) {
        return std::make_unique<PvtTarget>(std::move(table), machine, wishes.home);
    }
    return std::make_unique<SetpointTarget>(std::move(table), machine, wishes.home);
}

} // namespace splinefeed::host
