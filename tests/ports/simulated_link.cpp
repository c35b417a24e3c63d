// SPDX-License-Identifier: MIT
#include "simulated_link.hpp"

#include <algorithm>

namespace splinefeed_test {

using splinefeed::hal::modbus::BitTable;
using splinefeed::hal::modbus::exchange_bytes;
using splinefeed::hal::modbus::ExchangeBytes;
using splinefeed::hal::modbus::frame_us;
using splinefeed::hal::modbus::LinkFault;
using splinefeed::hal::modbus::place_in;
using splinefeed::hal::modbus::RegisterTable;
using splinefeed::hal::modbus::silence_us;
using splinefeed::hal::modbus::Wire;
using splinefeed::host::DriveModel;
using splinefeed::host::ModbusException;

namespace {

constexpr std::size_t block_registers = 11; // a write that long has a checksum of its own
constexpr std::uint64_t settle_us = 5000;   // as ModbusLink behind a fault

bool any_has(const std::vector<Span>& spans, std::uint64_t now_us) {
    return std::any_of(spans.begin(), spans.end(), [now_us](const Span& span) { return span.has(now_us); });
}

} // namespace

void Station::advance(std::uint64_t now_us) {
    began_us_ = began_us_ == 0 ? now_us : began_us_;
    const auto pass = [&](std::uint64_t until_us) {
        model_->advance(static_cast<std::uint64_t>(static_cast<double>(until_us - began_us_) * rate_));
    };
    while (!waiting_.empty() && waiting_.front().until_us <= now_us) {
        const Waiting first = std::move(waiting_.front());
        waiting_.pop_front();
        pass(std::max(first.until_us, began_us_));
        first.effect();
    }
    pass(now_us);
}

std::uint64_t Station::thaws_us(std::uint64_t now_us) const noexcept {
    for (const Span& span : frozen) {
        if (span.has(now_us)) {
            return span.to_us;
        }
    }
    return 0;
}

bool Station::is_mute(std::uint64_t now_us) const noexcept {
    return any_has(mute, now_us);
}

void Station::postpone(std::uint64_t until_us, std::function<void()> effect) {
    waiting_.push_back({until_us, std::move(effect)});
}

bool SimulatedLink::happens(double probability) {
    const bool yes = probability > 0.0 && wire_.faults_at.has(clock_.now_us()) &&
                     std::uniform_real_distribution<double>(0.0, 1.0)(wire_.random) < probability;
    wire_.hiccups += yes ? 1 : 0;
    return yes;
}

bool SimulatedLink::unplugged() const noexcept {
    return any_has(wire_.unplugged, clock_.now_us());
}

bool SimulatedLink::is_silent() {
    const std::uint64_t now_us = clock_.now_us();
    ++wire_.requests;
    for (const auto& [number, duration_us] : wire_.silences) {
        wire_.silent = number == wire_.requests ? Span{now_us, now_us + duration_us} : wire_.silent;
    }
    return wire_.silent.has(now_us);
}

SimulatedLink::OnWay* SimulatedLink::first_before(std::uint64_t instant_us) {
    const auto first = std::min_element(on_way_.begin(), on_way_.end(),
                                        [](const OnWay& a, const OnWay& b) { return a.at_us < b.at_us; });
    return first != on_way_.end() && first->at_us < instant_us ? &*first : nullptr;
}

// The first answer that comes belongs to an earlier request; ours comes behind it.
splinefeed::hal::modbus::LinkAnswer SimulatedLink::take_other(LinkAnswer answer, const OnWay& mine,
                                                              std::span<std::uint16_t> out) {
    OnWay* const first = first_before(UINT64_MAX);
    const OnWay other = std::move(*first);
    on_way_.erase(on_way_.begin() + (first - on_way_.data()));
    on_way_.push_back(mine);
    if (other.unit != mine.unit) {
        return fail(answer, LinkFault::wrong_unit, other.at_us);
    }
    if (other.kind != mine.kind || other.registers.size() != out.size()) {
        return fail(answer, LinkFault::wrong_length, other.at_us);
    }
    clock_.sleep_until_us(other.at_us);
    std::ranges::copy(other.registers, out.begin());
    answer.answered_us = answer.replied_us = quiet_from_us_ = clock_.now_us();
    answer.arrived_us = answer.sent_us;
    return answer;
}

bool SimulatedLink::connect() noexcept {
    clock_.sleep_us(wire_.latency_us);
    connected_ = !unplugged();
    dirty_ = behind_ = false;
    on_way_.clear();
    quiet_from_us_ = clock_.now_us();
    return connected_;
}

std::uint64_t SimulatedLink::next_us() const noexcept {
    constexpr std::size_t longest_frame = 256;
    const std::uint64_t settle = behind_  ? timing_.answer_us + frame_us(address_, longest_frame)
                                 : dirty_ ? settle_us
                                          : 0;
    return std::max(clock_.now_us(), quiet_from_us_ + silence_us(address_) + timing_.before_us + settle);
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::fail(LinkAnswer answer, LinkFault fault,
                                                        std::uint64_t at_us) noexcept {
    clock_.sleep_until_us(at_us);
    answer.fault = fault;
    answer.answered_us = quiet_from_us_ = clock_.now_us();
    dirty_ = fault != LinkFault::exception;
    connected_ = fault != LinkFault::disconnected;
    return answer;
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::transact(int unit, Registers written, std::span<std::uint16_t> out,
                                                            const std::function<Effect(Registers)>& effect) {
    LinkAnswer answer;
    answer.sent_us = answer.answered_us = clock_.now_us();
    if (!connected_) {
        answer.fault = LinkFault::disconnected;
        return answer;
    }
    const bool serial = address_.wire == Wire::rtu;
    const RequestKind kind = written.empty() ? RequestKind::reading
                             : out.empty()   ? RequestKind::write
                                             : RequestKind::exchange;
    const std::uint64_t content = splinefeed::hal::modbus::content_of(0, written);
    clock_.sleep_until_us(std::max(next_us(), serial ? open_.until_us(unit, kind, content) : 0));
    if (dirty_) {
        std::erase_if(on_way_, [&](const OnWay& other) { return other.at_us <= clock_.now_us(); });
    }
    dirty_ = behind_ = false;
    answer.sent_us = clock_.now_us();
    const auto miss = [&](LinkFault fault, std::uint64_t at_us) {
        const LinkAnswer missed = fail(answer, fault, at_us);
        if (serial) {
            open_.missed(unit, kind, content, clock_.now_us());
        }
        return missed;
    };
    if (unplugged()) {
        return fail(answer, LinkFault::disconnected, answer.sent_us + wire_.latency_us);
    }
    const ExchangeBytes bytes = exchange_bytes(address_, written.size(), out.size());
    const auto takes_us = [this](std::size_t frame) {
        return static_cast<std::uint64_t>(wire_.pace * static_cast<double>(frame_us(address_, frame)));
    };
    const std::uint64_t deadline_us =
        answer.sent_us + timing_.answer_us + frame_us(address_, bytes.request + bytes.reply);
    const std::uint64_t latency_us = wire_.latency_us + wire_.random() % (wire_.latency_us + 1);
    if (any_has(wire_.flooded, answer.sent_us)) {
        return fail(answer, serial ? LinkFault::corrupt : LinkFault::disconnected, deadline_us);
    }
    const bool damages_request = happens(wire_.faults.corrupt) && !out.empty();
    clock_.sleep_until_us(answer.sent_us + takes_us(bytes.request) + latency_us / 2);
    const std::uint64_t now_us = clock_.now_us();
    const auto found = wire_.stations.find(unit);
    if (is_silent() || found == wire_.stations.end() || found->second->is_mute(now_us) || unplugged() ||
        happens(wire_.faults.lost_request) || (serial && damages_request && wire_.random() % 2 == 0)) {
        return miss(LinkFault::timeout, deadline_us);
    }
    if (!serial && damages_request && written.size() >= block_registers) {
        written[wire_.random() % written.size()] ^= static_cast<std::uint16_t>(1U << wire_.random() % 16);
    }
    Station& station = *found->second;
    Registers read(out.size());
    const Effect does = effect(std::move(written));
    if (const std::uint64_t thaws_us = station.thaws_us(now_us); thaws_us != 0) {
        station.postpone(thaws_us,
                         [&station, does, read]() mutable { static_cast<void>(does(station.model(), read)); });
        return miss(LinkFault::timeout, deadline_us);
    }
    station.advance(now_us);
    const bool busy = happens(wire_.faults.exception);
    ModbusException exception = busy ? wire_.exception : does(station.model(), read);
    if (!busy && happens(wire_.faults.repeated)) {
        exception = does(station.model(), read);
    }
    const std::uint64_t late_us = happens(wire_.faults.late) ? wire_.random() % wire_.faults.late_us : 0;
    const std::uint64_t answers_us = now_us + latency_us / 2 + takes_us(bytes.reply) + late_us;
    if (happens(wire_.faults.lost_answer) || happens(wire_.faults.broken)) {
        return miss(LinkFault::timeout, deadline_us);
    }
    const OnWay mine{answers_us, unit, kind, read};
    if (serial && exception == ModbusException::none) {
        if (first_before(std::min(answers_us, deadline_us)) != nullptr) {
            LinkAnswer other = take_other(answer, mine, out);
            if (!other.ok()) {
                open_.missed(unit, kind, content, clock_.now_us());
            }
            return other;
        }
        if (answers_us > deadline_us || happens(wire_.faults.foreign)) {
            on_way_.push_back(mine);
            return answers_us > deadline_us ? miss(LinkFault::timeout, deadline_us)
                                            : miss(LinkFault::wrong_unit, answers_us);
        }
    }
    if (answers_us > deadline_us) {
        return fail(answer, LinkFault::timeout, deadline_us);
    }
    if (!serial && happens(wire_.faults.foreign)) {
        return fail(answer, LinkFault::wrong_length, answers_us);
    }
    if (exception != ModbusException::none) {
        answer.exception = static_cast<std::uint8_t>(exception);
        return fail(answer, LinkFault::exception, answers_us);
    }
    if (serial && damages_request) {
        return fail(answer, LinkFault::corrupt, answers_us);
    }
    clock_.sleep_until_us(answers_us);
    if (serial) {
        open_.answered(unit, kind);
    }
    answer.answered_us = quiet_from_us_ = clock_.now_us();
    answer.arrived_us = answer.sent_us + frame_us(address_, bytes.request);
    answer.replied_us = answer.answered_us - frame_us(address_, bytes.reply);
    Registers& earlier = earlier_[{unit, out.size()}];
    const bool stale = !earlier.empty() && !out.empty() && happens(wire_.faults.stale);
    std::copy_n((stale ? earlier : read).begin(), out.size(), out.begin());
    earlier = std::move(read);
    return answer;
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::read(int unit, int address, std::span<std::uint16_t> out) noexcept {
    return transact(unit, {}, out, [address](const Registers&) -> Effect {
        return [address](DriveModel& model, Registers& in) {
            return model.read(address, in);
        };
    });
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::read_inputs(int unit, int address,
                                                               std::span<std::uint16_t> out) noexcept {
    return read(unit, place_in(RegisterTable::input, address), out);
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::read_bit(int unit, BitTable table, int address, bool& out) noexcept {
    std::uint16_t bit = 0;
    const RegisterTable where = table == BitTable::coils ? RegisterTable::coils : RegisterTable::discrete;
    const LinkAnswer answer = read(unit, place_in(where, address), std::span(&bit, 1));
    out = answer.ok() ? bit != 0 : out;
    return answer;
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::write_coil(int unit, int address, bool on) noexcept {
    const std::uint16_t bit = on ? 1 : 0;
    return write(unit, place_in(RegisterTable::coils, address), std::span(&bit, 1));
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::write(int unit, int address,
                                                         std::span<const std::uint16_t> values) noexcept {
    return transact(unit, {values.begin(), values.end()}, {}, [address](Registers written) -> Effect {
        return [address, written = std::move(written)](DriveModel& model, Registers& /*in*/) {
            return model.write(address, written);
        };
    });
}

splinefeed::hal::modbus::LinkAnswer SimulatedLink::exchange(int unit, int write_address,
                                                            std::span<const std::uint16_t> values, int read_address,
                                                            std::span<std::uint16_t> out) noexcept {
    return transact(unit, {values.begin(), values.end()}, out, [=](Registers written) -> Effect {
        return [=, written = std::move(written)](DriveModel& model, Registers& in) {
            const ModbusException refused = model.write(write_address, written);
            return refused != ModbusException::none ? refused : model.read(read_address, in);
        };
    });
}

} // namespace splinefeed_test
