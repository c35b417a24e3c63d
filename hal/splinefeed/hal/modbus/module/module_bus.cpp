// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/module/module_bus.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <utility>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t slice_us = 2000; // what is set waits for so long at most, and an exchange

LinkTiming timing_of_module(const ModuleBusSettings& settings) {
    return {.answer_us = static_cast<std::uint32_t>(us_per_ms) * settings.answer_ms, .retries = settings.retries};
}

} // namespace

ModuleBus::ModuleBus(const LinkAddress& wire, const ModuleBusSettings& settings, const MakeWire& make, Clock& clock)
    : settings_(settings), clock_(&clock), wire_(wire), link_(make(wire, timing_of_module(settings), clock)) {}

ModuleBus::~ModuleBus() {
    if (thread_ == nullptr) {
        return;
    }
    end();
    const std::uint64_t until_us = clock_->now_us() + us_per_ms * settings_.lost_ms;
    while (!unconfirmed().empty() && clock_->now_us() < until_us) {
        clock_->sleep_us(slice_us);
    }
    leaves_.store(true);
    thread_->join();
}

ModuleBus::Module& ModuleBus::module_of(int unit) {
    const auto found =
        std::find_if(modules_.begin(), modules_.end(), [unit](const Module& module) { return module.unit == unit; });
    if (found != modules_.end()) {
        return *found;
    }
    modules_.emplace_back().unit = unit;
    return modules_.back();
}

std::size_t ModuleBus::add_coil(ModuleBit bit, bool safe) {
    module_of(bit.unit).coils.push_back(coils_.size());
    coils_.push_back({std::move(bit), safe, safe});
    return coils_.size() - 1;
}

std::size_t ModuleBus::add_input(ModuleBit bit) {
    module_of(bit.unit).inputs.push_back(inputs_.size());
    inputs_.push_back(std::move(bit));
    return inputs_.size() - 1;
}

bool ModuleBus::connected() {
    return link_->connected() || link_->connect();
}

LinkAnswer ModuleBus::read(const ModuleBit& bit, bool& out) {
    return connected() ? link_->read_bit(bit.unit, bit.table, bit.address, out)
                       : LinkAnswer{.fault = LinkFault::disconnected};
}

LinkAnswer ModuleBus::write(const ModuleBit& bit, bool on) {
    return connected() ? link_->write_coil(bit.unit, bit.address, on) : LinkAnswer{.fault = LinkFault::disconnected};
}

template <class Exchange>
std::string ModuleBus::try_out(const ModuleBit& bit, const Exchange& exchange) {
    LinkAnswer answer{.fault = LinkFault::timeout};
    for (int i = 0; i <= settings_.retries && !answer.ok() && !answer.refused(); ++i) {
        answer = exchange();
    }
    return answer.ok() ? std::string() : bit.name + ": " + describe(answer, *link_);
}

std::string ModuleBus::open() {
    bool ignored = false;
    std::string what;
    for (const ModuleBit& bit : inputs_) {
        what = what.empty() ? try_out(bit, [&] { return read(bit, ignored); }) : what;
    }
    for (const Coil& coil : coils_) {
        what = what.empty() ? try_out(coil.bit, [&] { return read(coil.bit, ignored); }) : what;
    }
    for (Coil& coil : coils_) {
        what = what.empty() ? try_out(coil.bit, [&] { return write(coil.bit, coil.safe); }) : what;
        coil.told = coil.safe;
    }
    if (!what.empty()) {
        return what;
    }
    for (Module& module : modules_) {
        module.answered_us = module.look_us = clock_->now_us();
    }
    thread_ = clock_->start([this] { work(); });
    return {};
}

void ModuleBus::set(std::size_t coil, bool on) {
    const std::lock_guard lock(mutex_);
    if (!ended_) {
        coils_[coil].wanted = on;
    }
}

void ModuleBus::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    for (Coil& coil : coils_) {
        coil.wanted = coil.safe;
    }
}

std::string ModuleBus::unconfirmed() const {
    const std::lock_guard lock(mutex_);
    for (const Coil& coil : coils_) {
        if (coil.told != coil.wanted) {
            return coil.bit.name;
        }
    }
    return {};
}

void ModuleBus::watch(std::size_t input) {
    const std::lock_guard lock(mutex_);
    watched_ = input;
    reading_.reset();
    ++watches_;
}

void ModuleBus::unwatch() {
    const std::lock_guard lock(mutex_);
    watched_.reset();
    reading_.reset();
    ++watches_;
}

std::optional<ModuleBus::Reading> ModuleBus::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(reading_, std::nullopt);
}

std::string ModuleBus::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

// The first trouble is told; whatever it is, all coils become safe.
void ModuleBus::fail(const std::string& what) {
    {
        const std::lock_guard lock(mutex_);
        if (!ended_ && trouble_.empty()) {
            trouble_ = what;
        }
    }
    end();
}

// Whether the exchange was good; else what follows from that.
bool ModuleBus::took(const ModuleBit& bit, const LinkAnswer& answer) {
    Module& module = module_of(bit.unit);
    const std::uint64_t now_us = clock_->now_us();
    if (answer.ok() || answer.refused()) {
        module.answered_us = now_us;
    }
    if (answer.refused()) {
        fail(bit.name + ": " + describe(answer, *link_));
    } else if (!answer.ok() && now_us > module.answered_us + us_per_ms * settings_.lost_ms) {
        fail(bit.name +
             (answer.fault == LinkFault::exception ? ": its module answers nothing but "
                                                   : ": its module does not answer: ") +
             describe(answer, *link_));
    }
    return answer.ok();
}

// It would wait for what the module may still answer, and other modules for that.
bool ModuleBus::may_not_read(int unit) const {
    return clock_->now_us() < link_->read_from_us(unit);
}

void ModuleBus::work() {
    while (!leaves_.load()) {
        write_coils();
        read_watched();
        for (Module& module : modules_) {
            const bool due = clock_->now_us() >= module.look_us || link_->owes_answer(module.unit);
            if (due && !may_not_read(module.unit)) {
                look(module);
                module.look_us = clock_->now_us() + us_per_ms * settings_.look_ms;
            }
        }
        clock_->sleep_us(slice_us);
    }
}

// What is set while another coil is written comes before the rest: each is looked at again. No lock is held meanwhile.
// A module that does not answer keeps the others from their turn once only, however many coils it has: that coil is
// tried until it is confirmed, then the rest of them.
void ModuleBus::write_coils() {
    std::optional<int> silent;
    for (Coil& coil : coils_) {
        if (silent == coil.bit.unit) {
            continue;
        }
        bool on = false;
        {
            const std::lock_guard lock(mutex_);
            if (coil.told == coil.wanted) {
                continue;
            }
            on = coil.wanted;
            coil.told.reset(); // it may take what it does not confirm
        }
        const LinkAnswer answer = write(coil.bit, on);
        if (took(coil.bit, answer)) {
            const std::lock_guard lock(mutex_);
            coil.told = on;
        } else if (answer.fault != LinkFault::exception) {
            silent = coil.bit.unit;
        }
    }
}

void ModuleBus::read_watched() {
    std::optional<std::size_t> input;
    std::uint64_t watch = 0;
    {
        const std::lock_guard lock(mutex_);
        input = watched_;
        watch = watches_;
    }
    if (!input || may_not_read(inputs_[*input].unit)) {
        return;
    }
    Reading reading{.asked_us = clock_->now_us()};
    if (took(inputs_[*input], read(inputs_[*input], reading.on))) {
        const std::lock_guard lock(mutex_);
        if (watch == watches_) {
            reading_ = reading;
        }
    }
}

// A coil or an input in turn, so that a module that is lost is noticed, and one that has a watchdog hears of us.
void ModuleBus::look(Module& module) {
    const std::size_t turn = module.turn++;
    if (!module.coils.empty()) {
        look_at_coil(module.coils[turn % module.coils.size()]);
        return;
    }
    bool ignored = false;
    const ModuleBit& bit = inputs_[module.inputs[turn % module.inputs.size()]];
    static_cast<void>(took(bit, read(bit, ignored)));
}

void ModuleBus::look_at_coil(std::size_t index) {
    const ModuleBit& bit = coils_[index].bit;
    bool on = false;
    if (!took(bit, read(bit, on))) {
        return;
    }
    bool differs = false;
    {
        const std::lock_guard lock(mutex_);
        std::optional<bool>& told = coils_[index].told; // only this thread changes it
        differs = told && *told != on;
        if (differs) {
            told.reset(); // it is written again
        }
    }
    if (differs) {
        fail(bit.name + ": it is " + (on ? "on" : "off") +
             ", as it was not set; has its module been off, or does somebody else switch it?");
    }
}

} // namespace splinefeed::hal::modbus
