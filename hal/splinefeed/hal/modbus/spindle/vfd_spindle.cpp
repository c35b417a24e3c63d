// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/spindle/vfd_spindle.hpp"

#include "splinefeed/base/units.hpp"

#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t slice_us = 5000; // an order waits for so long at most, and an exchange
constexpr double still_hz = 0.5;         // the output of a VFD whose spindle stands
constexpr double near_share = 0.02;      // of the speed: it is reached
constexpr double near_hz = 0.2;
constexpr double lost_share = 0.5; // of the speed: it has been lost
constexpr int lost_readings = 3;

DriveCommand command_of(int direction) {
    return direction > 0 ? DriveCommand::forward : direction < 0 ? DriveCommand::reverse : DriveCommand::stop;
}

std::string number(double value) {
    return std::to_string(std::lround(value));
}

} // namespace

VfdSpindle::VfdSpindle(VfdWiring wiring, const VfdSpindleSettings& settings, const MakeWire& make, Clock& clock)
    : settings_(settings), clock_(&clock), client_(std::move(wiring), make, clock) {}

VfdSpindle::~VfdSpindle() {
    if (thread_ == nullptr) {
        return;
    }
    end();
    const std::uint64_t until_us = clock_->now_us() + us_per_ms * settings_.lost_ms;
    while (was_on() && !stands() && clock_->now_us() < until_us) {
        clock_->sleep_us(slice_us);
    }
    leaves_.store(true);
    thread_->join();
}

std::string VfdSpindle::open() {
    VfdReading reading;
    LinkAnswer answer{.fault = LinkFault::timeout};
    for (int i = 0; i <= client_.profile().link.retries && !answer.ok(); ++i) {
        answer = client_.command(DriveCommand::stop);
        if (answer.ok()) {
            answer = client_.read(reading);
        }
    }
    if (!answer.ok()) {
        return answer.refused() ? std::string("it refuses a stop or a reading: ") + exception_name(answer.exception)
                                : client_.describe(answer);
    }
    if (reading.fault) {
        return "it is in fault, code " + std::to_string(reading.fault_code) + ": reset it";
    }
    known_ = true;
    turns_ = was_on_ = reading.output_hz >= still_hz;
    output_hz_ = reading.output_hz;
    answered_us_ = clock_->now_us();
    thread_ = clock_->start([this] { work(); });
    return {};
}

void VfdSpindle::order(const SpindleOrder& order) {
    const std::lock_guard lock(mutex_);
    if (ended_) {
        return;
    }
    wanted_ = {order.direction, order.direction == 0 ? 0.0 : client_.nearest_hz(order.hz)};
    was_on_ = was_on_ || order.direction != 0;
    stands_ = false;
    ++ordered_;
}

void VfdSpindle::end() {
    const std::lock_guard lock(mutex_);
    if (!ended_) {
        ended_ = true;
        wanted_ = {};
        stands_ = false;
        ++ordered_;
    }
}

bool VfdSpindle::ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
}

bool VfdSpindle::reached() const {
    const std::lock_guard lock(mutex_);
    return !ended_ && carried_out_ == ordered_;
}

bool VfdSpindle::stands() const {
    const std::lock_guard lock(mutex_);
    return stands_;
}

bool VfdSpindle::was_on() const {
    const std::lock_guard lock(mutex_);
    return was_on_;
}

// A spindle that may turn has to be heard of, and an order is waited for.
bool VfdSpindle::awaited() const {
    const std::lock_guard lock(mutex_);
    return (was_on_ && !stands_) || (!ended_ && carried_out_ != ordered_);
}

std::string VfdSpindle::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

double VfdSpindle::output_hz() const {
    const std::lock_guard lock(mutex_);
    return output_hz_;
}

void VfdSpindle::work() {
    std::uint64_t next_us = clock_->now_us();
    while (!leaves_.load()) {
        const std::uint64_t now_us = clock_->now_us();
        bool fresh = false;
        {
            const std::lock_guard lock(mutex_);
            fresh = seen_ != ordered_;
        }
        if (fresh || now_us >= next_us) {
            step();
            // A stop that was not taken is repeated at once.
            next_us = clock_->now_us() + (known_ ? us_per_ms * settings_.poll_ms : 0);
        }
        clock_->sleep_us(slice_us);
    }
}

// The first trouble is told; whatever it is, the spindle ends.
void VfdSpindle::fail(const std::string& what) {
    {
        const std::lock_guard lock(mutex_);
        if (!ended_ && trouble_.empty()) {
            trouble_ = what;
        }
    }
    end();
}

bool VfdSpindle::took(const LinkAnswer& answer, const char* what) {
    const std::uint64_t now_us = clock_->now_us();
    if (answer.ok()) {
        answered_us_ = now_us;
        return true;
    }
    if (answer.refused()) {
        answered_us_ = now_us;
        fail(std::string("the VFD refuses ") + what + ": " + exception_name(answer.exception));
    } else if (now_us > answered_us_ + us_per_ms * settings_.lost_ms && awaited()) {
        fail((answer.fault == LinkFault::exception ? "the VFD answers nothing but " : "the VFD does not answer: ") +
             client_.describe(answer));
    }
    return false;
}

// Again, where it stands in an order that it has not obeyed, or somebody else has turned it on.
bool VfdSpindle::stop() {
    known_ = took(client_.command(DriveCommand::stop), "a stop");
    if (known_) {
        told_ = {};
    }
    return known_;
}

// One step at a time: the reading behind it says whether the next one may be made.
void VfdSpindle::carry_out(const SpindleOrder& order, bool fresh) {
    if (order.direction == 0) {
        if (fresh || !known_ || told_.direction != 0 || turns_) {
            static_cast<void>(stop());
        }
        return;
    }
    if (!known_ || told_.direction == -order.direction) {
        static_cast<void>(stop());
        return;
    }
    if (turns_ && turned_ != order.direction) {
        return; // the other direction comes when it stands
    }
    if (told_.direction == order.direction && told_.hz == order.hz) {
        return;
    }
    told_.hz = -1.0; // it may take what it does not confirm
    if (!took(client_.write_speed(order.hz), "the speed") || ended()) {
        return;
    }
    if (told_.direction != order.direction) {
        known_ = false;
        turned_ = order.direction;
        if (!took(client_.command(command_of(order.direction)), "to run")) {
            return;
        }
        known_ = true;
    }
    told_ = order;
}

// After a reading that failed it is told once more what it has been told: an answer to that says that none of the
// reading is to come any more, and the next reading is not that old one.
void VfdSpindle::step() {
    SpindleOrder order;
    bool fresh = false;
    {
        const std::lock_guard lock(mutex_);
        order = wanted_;
        fresh = seen_ != ordered_;
        seen_ = ordered_;
    }
    if (fresh) {
        began_us_ = clock_->now_us();
        slow_ = 0;
    }
    carry_out(order, fresh);
    VfdReading reading;
    if ((!known_ && order.direction == 0) || !client_.may_read()) {
        return;
    }
    if (took(client_.read(reading), "a reading")) {
        judge(order, reading);
    } else if (order.direction == 0) {
        known_ = false;
    } else {
        told_.hz = -1.0;
    }
}

void VfdSpindle::judge(const SpindleOrder& order, const VfdReading& reading) {
    const bool taken = known_ && told_.direction == order.direction && told_.hz == order.hz;
    const bool near = std::fabs(reading.output_hz - order.hz) <= near_hz + near_share * order.hz;
    turns_ = reading.output_hz >= still_hz;
    turned_ = turns_ || told_.direction != 0 ? turned_ : 0;
    bool reached = false;
    {
        const std::lock_guard lock(mutex_);
        output_hz_ = reading.output_hz;
        if (seen_ == ordered_) { // else another order came meanwhile
            stands_ = taken && order.direction == 0 && !turns_;
            if (taken && (order.direction == 0 || (near && reading.done))) {
                carried_out_ = seen_;
            }
        }
        reached = carried_out_ == seen_;
    }
    if (reading.fault) {
        fail("the VFD is in fault, code " + std::to_string(reading.fault_code));
        return;
    }
    if (order.direction == 0) {
        return;
    }
    if (!reached && clock_->now_us() > began_us_ + us_per_ms * settings_.at_speed_timeout_ms) {
        fail("the spindle has not reached its speed in " + number(settings_.at_speed_timeout_ms / 1e3) +
             " s: the VFD's output is " + number(reading.output_hz) + " of " + number(order.hz) + " Hz");
    }
    slow_ = reached && reading.output_hz < lost_share * order.hz ? slow_ + 1 : 0;
    if (slow_ >= lost_readings) {
        fail("the spindle has lost its speed: the VFD's output is " + number(reading.output_hz) + " of " +
             number(order.hz) + " Hz");
    }
}

} // namespace splinefeed::hal::modbus
