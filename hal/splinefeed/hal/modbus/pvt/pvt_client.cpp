// SPDX-License-Identifier: MIT
//
// Every segment runs exactly once. The next block starts with the segment that the drive expects: `next` of the last
// status that answers our last request (nonce), is complete (checksum) and is from the same power cycle (boot number).
// Without an answer the next block begins with the same segment, and the drive skips segments that it has already.
// Segments stay in the queue until they are executed, because `end` makes the drive drop segments.
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_tables.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t listen_every_us = 4'000; // while the drive moves, and until its standstill is confirmed
constexpr std::uint64_t idle_every_us = 20'000;  // while it is at standstill
constexpr std::uint64_t connect_every_us = 20'000;
constexpr std::uint16_t most_refusals = 20; // of errors that a repetition does not cure
constexpr std::uint8_t illegal_function = 1;

ExchangeInstants instants_of(const LinkAnswer& answer) noexcept {
    return {answer.sent_us, answer.arrived_us, answer.replied_us, answer.answered_us};
}

} // namespace

PvtClient::PvtClient(ModbusWire& link, int unit, bool both_in_one)
    : link_(&link), unit_(unit), queue_(queue_capacity), both_in_one_(both_in_one) {}

DriveProblem PvtClient::open(int least_axes) noexcept {
    const std::lock_guard lock(mutex_);
    return report_.problem = start_session(least_axes);
}

DriveProblem PvtClient::start_session(int least_axes) noexcept {
    if (!link_->connected() && !link_->connect()) {
        return DriveProblem::unreachable;
    }
    PvtTables tables(*link_, unit_, report_);
    std::array<std::uint16_t, pvt::identity_registers> raw{};
    DriveProblem problem = tables.read(pvt::identity_address, raw, DriveProblem::not_pvt);
    if (problem != DriveProblem::none) {
        return problem;
    }
    const PvtIdentity identity = decode_identity(raw);
    report_.identity = identity;
    problem = identity_problem(identity, least_axes);
    if (problem != DriveProblem::none) {
        return problem;
    }
    axes_ = identity.axes;
    problem = tables.read_status(axes_, report_.status);
    if (problem != DriveProblem::none) {
        return problem;
    }
    report_.answered_us = link_->clock().now_us();
    // Differs from the previous client's session, so the drive refuses late blocks of that client.
    session_ = static_cast<std::uint16_t>(report_.answered_us ^ (report_.answered_us >> 16U));
    counter_ = report_.status.last_command;
    nonce_ = static_cast<std::uint16_t>(report_.status.nonce + 1U);
    began_ = false;
    clear_command(); // of the session before
    return DriveProblem::none;
}

// Reads, changes and writes back: values that are not set stay.
DriveProblem PvtClient::configure(const PvtSettings& wanted) noexcept {
    const std::lock_guard lock(mutex_);
    report_.clock.clear(); // a run uses only exchanges with a nonce
    return report_.problem = change_configuration(wanted);
}

DriveProblem PvtClient::change_configuration(const PvtSettings& wanted) noexcept {
    PvtTables tables(*link_, unit_, report_);
    std::array<std::uint16_t, pvt::configuration_registers> registers{};
    const DriveProblem problem = tables.read(pvt::configuration_address, registers, DriveProblem::refused);
    if (problem != DriveProblem::none) {
        return problem;
    }
    PvtConfiguration configuration = decode_configuration(registers);
    configuration.stop_reserve_ms = wanted.stop_reserve_ms.value_or(configuration.stop_reserve_ms);
    configuration.watchdog_ms = wanted.watchdog_ms.value_or(configuration.watchdog_ms);
    configuration.following_window = wanted.following_window.value_or(configuration.following_window);
    encode(configuration, registers);
    return tables.write(pvt::configuration_address, registers);
}

DriveProblem PvtClient::read_status() noexcept {
    const std::lock_guard lock(mutex_);
    return report_.problem = PvtTables(*link_, unit_, report_).read_status(axes_, report_.status);
}

LinkAnswer PvtClient::probe() noexcept {
    const std::lock_guard lock(mutex_);
    if (!link_->connected()) {
        static_cast<void>(link_->connect());
    }
    std::array<std::uint16_t, pvt::status_registers(max_axes)> raw{};
    const std::span<std::uint16_t> whole(raw.data(), pvt::status_registers(axes_));
    // Without a nonce a late answer to an earlier read is not recognised: its clock must not be used.
    const bool nothing_late_before = report_.last_fault == LinkFault::none;
    LinkAnswer answer = link_->read(unit_, pvt::status_address, whole);
    if (answer.ok() && !status_holds(whole)) {
        answer.fault = LinkFault::corrupt;
    }
    report_.count(answer);
    if (answer.ok()) {
        report_.status = decode_status(whole, axes_);
        if (nothing_late_before && answer.arrived_us <= answer.replied_us) {
            sample_clock(answer);
        }
    }
    return answer;
}

void PvtClient::sample_clock(const LinkAnswer& answer) noexcept {
    report_.clock.sample(instants_of(answer), report_.status.clock_us);
    report_.answered_us = answer.answered_us;
    report_.status_us = report_.clock.earliest_us(instants_of(answer));
}

std::size_t PvtClient::room() const noexcept {
    return queue_capacity - (tail_.load(std::memory_order_relaxed) - head_.load(std::memory_order_acquire));
}

bool PvtClient::push(const PvtSegment& segment) noexcept {
    if (room() == 0) {
        return false; // the place still has a segment that the drive may not have
    }
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    queue_[tail % queue_capacity] = segment;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
}

void PvtClient::command(PvtCommand command, std::uint32_t argument, const PvtSegment& preset) noexcept {
    const std::lock_guard lock(mutex_);
    SPLINEFEED_ASSERT(pending_.command == PvtCommand::none);
    if (command == PvtCommand::begin) {
        head_.store(argument);
        tail_.store(argument);
        sent_ = argument;
        first_ = argument;
        executed_ = 0;
        began_ = false; // statuses that are under way have the numbers of before
    }
    pending_ = {command, argument, preset};
    report_.command_pending = true;
    report_.command_refused = false;
    ++counter_;
}

void PvtClient::interrupt(PvtCommand command, std::uint32_t argument) noexcept {
    const std::lock_guard lock(mutex_);
    pending_ = {command, argument, {}};
    report_.command_pending = true;
    report_.command_refused = false;
    ++counter_;
}

std::int64_t PvtClient::drive_us(std::uint64_t host_us) const noexcept {
    const std::lock_guard lock(mutex_);
    return report_.clock.drive_us(host_us);
}

DriveReport PvtClient::report() const noexcept {
    const std::lock_guard lock(mutex_);
    return report_;
}

// Whether an exchange is due; `waiting`: number of segments that the drive does not have yet.
bool PvtClient::due(std::uint64_t now_us, std::uint32_t waiting) const noexcept {
    if (pending_.command != PvtCommand::none) {
        return true;
    }
    // Send full blocks only, as long as the drive's ring is well filled.
    const std::uint32_t fits = waiting < report_.status.free ? waiting : report_.status.free;
    if (fits >= pvt::most_segments(axes_) || (fits > 0 && 2U * report_.status.free > report_.identity.ring)) {
        return true;
    }
    const bool moves = report_.status.state == PvtState::running || report_.status.state == PvtState::stopping;
    const bool stops = held_back_.load(std::memory_order_relaxed);
    return now_us - last_exchange_us_ >= (moves || stops ? listen_every_us : idle_every_us);
}

void PvtClient::fill(PvtBlock& block, std::uint32_t waiting) noexcept {
    block.nonce = ++nonce_;
    block.session = session_;
    block.first = report_.status.next;
    if (pending_.command != PvtCommand::none) {
        block.command = pending_.command;
        block.command_counter = counter_;
        block.argument = pending_.argument;
        if (pending_.command == PvtCommand::preset_position) {
            block.count = 1;
            batch_[0] = pending_.preset;
        }
        return;
    }
    block.command_counter = counter_;
    auto count = static_cast<std::uint32_t>(pvt::most_segments(axes_));
    count = waiting < count ? waiting : count;
    count = report_.status.free < count ? report_.status.free : count;
    for (std::uint32_t i = 0; i < count; ++i) {
        batch_[i] = queue_[(block.first + i) % queue_capacity];
    }
    block.count = static_cast<std::uint16_t>(count);
    const auto known = static_cast<std::int32_t>(sent_ - block.first);
    report_.counts.resent += count > 0 && known > 0 ? 1U : 0U;
    sent_ = static_cast<std::int32_t>(count) > known ? block.first + count : sent_;
}

LinkAnswer PvtClient::exchange(std::span<const std::uint16_t> block, std::span<std::uint16_t> status) noexcept {
    if (both_in_one_) {
        const LinkAnswer answer = link_->exchange(unit_, pvt::block_address, block, pvt::status_address, status);
        if (answer.fault != LinkFault::exception || answer.exception != illegal_function) {
            return answer;
        }
        both_in_one_ = false;
    }
    const LinkAnswer written = link_->write(unit_, pvt::block_address, block);
    return written.ok() ? link_->read(unit_, pvt::status_address, status) : written;
}

bool PvtClient::reconnect(std::uint64_t now_us) noexcept {
    if (now_us - last_connect_us_ < connect_every_us) {
        return false;
    }
    last_connect_us_ = now_us;
    return link_->connect();
}

bool PvtClient::step() noexcept {
    const std::uint64_t now = link_->clock().now_us();
    if (!link_->connected() && !reconnect(now)) {
        return false;
    }
    PvtBlock block;
    {
        const std::lock_guard lock(mutex_);
        const bool stands =
            report_.problem == DriveProblem::power_cycled || report_.problem == DriveProblem::out_of_step;
        const std::uint32_t waiting = stands || !began_ || held_back_.load(std::memory_order_relaxed)
                                          ? 0
                                          : tail_.load(std::memory_order_acquire) - report_.status.next;
        if (!due(now, waiting)) {
            return false;
        }
        fill(block, waiting);
    }
    const std::size_t size = encode(block, batch_, axes_, block_);
    std::array<std::uint16_t, pvt::status_registers(max_axes)> raw{};
    const std::span<std::uint16_t> status(raw.data(), pvt::status_registers(axes_));
    const LinkAnswer answer = exchange(std::span(block_).first(size), status);
    last_exchange_us_ = answer.answered_us;
    const std::lock_guard lock(mutex_);
    handle_answer(answer, block, status);
    return true;
}

void PvtClient::handle_answer(const LinkAnswer& answer, const PvtBlock& block,
                              std::span<const std::uint16_t> raw) noexcept {
    report_.count(answer);
    if (!answer.ok()) {
        return;
    }
    const PvtStatus status = decode_status(raw, axes_);
    if (!status_holds(raw)) {
        const bool words = status.boot == swapped_words(report_.identity.boot);
        report_.problem = words ? DriveProblem::words_swapped : report_.problem;
        ++report_.counts.corrupt;
        return;
    }
    if (status.nonce != block.nonce) {
        ++report_.counts.stale;
        link_->resynchronise();
        return;
    }
    if (const DriveProblem problem = check_status(status); problem != DriveProblem::none) {
        report_.problem = problem;
        report_.status = status;
        report_.answered_us = answer.answered_us;
        report_.status_us = report_.clock.earliest_us(instants_of(answer));
        resolve_command(status, block); // the drive can still be stopped
        return;
    }
    publish_report(status, block);
    sample_clock(answer);
}

// Checks whether the status is plausible.
DriveProblem PvtClient::check_status(const PvtStatus& status) const noexcept {
    if (status.boot != report_.identity.boot) {
        return status.boot == swapped_words(report_.identity.boot) ? DriveProblem::words_swapped
                                                                   : DriveProblem::power_cycled;
    }
    if (status.state > PvtState::homing) {
        return DriveProblem::unknown_state;
    }
    const auto sent = static_cast<std::int32_t>(sent_ - head_.load(std::memory_order_relaxed));
    const auto executed = static_cast<std::int32_t>(status.executed - head_.load(std::memory_order_relaxed));
    const auto next = static_cast<std::int32_t>(status.next - head_.load(std::memory_order_relaxed));
    return began_ && (executed < 0 || next < executed || next > sent) ? DriveProblem::out_of_step : DriveProblem::none;
}

void PvtClient::clear_command() noexcept {
    pending_.command = PvtCommand::none;
    report_.command_pending = false;
}

// Handles the drive's answer to the command in the block.
void PvtClient::resolve_command(const PvtStatus& status, const PvtBlock& block) noexcept {
    if (pending_.command == PvtCommand::none || block.command != pending_.command ||
        block.command_counter != counter_) {
        return;
    }
    if (status.refused == PvtRefusal::none) {
        if (status.last_command == counter_) {
            const bool begins = pending_.command == PvtCommand::begin;
            if (begins && (status.next != pending_.argument || status.executed != pending_.argument)) {
                report_.problem = DriveProblem::out_of_step;
            }
            const bool loses_ring =
                pending_.command == PvtCommand::quick_stop || pending_.command == PvtCommand::disable;
            began_ = (began_ || begins) && !loses_ring;
            clear_command();
        }
    } else if (status.refused != PvtRefusal::checksum && status.refused != PvtRefusal::no_room &&
               status.refused != PvtRefusal::gap) {
        report_.command_refused = true; // its state changed meanwhile: the caller decides again
        clear_command();
    }
}

void PvtClient::publish_report(const PvtStatus& status, const PvtBlock& block) noexcept {
    LinkCounts& counts = report_.counts;
    if (status.refused == PvtRefusal::none) {
        refusals_in_row_ = 0;
    } else if (status.refused == PvtRefusal::session && began_ && status.state != PvtState::fault) {
        report_.problem = DriveProblem::taken; // a drive ends a session by itself only in a fault and by power-up
    } else if (status.refused == PvtRefusal::checksum) {
        ++counts.corrupt;
    } else if (status.refused != PvtRefusal::no_room && status.refused != PvtRefusal::gap) {
        // Without a session the drive refuses every block that only requests the status.
        const bool counts_as_one = began_ || block.command != PvtCommand::none;
        refusals_in_row_ = static_cast<std::uint16_t>(refusals_in_row_ + (counts_as_one ? 1 : 0));
        if (refusals_in_row_ >= most_refusals) {
            report_.problem = DriveProblem::refused;
        }
    }
    resolve_command(status, block);
    report_.status = status;
    if (began_) {
        executed_ += status.executed - head_.load(std::memory_order_relaxed); // sequence numbers wrap
        counts.segments = executed_ + (status.next - status.executed);
        head_.store(status.executed, std::memory_order_release);
    }
    if (status.state == PvtState::fault) {
        report_.problem = DriveProblem::fault;
    } else if (report_.problem == DriveProblem::fault) {
        report_.problem = DriveProblem::none; // the fault was reset
    }
}

} // namespace splinefeed::hal::modbus
