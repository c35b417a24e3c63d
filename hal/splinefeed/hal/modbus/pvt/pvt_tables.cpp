// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_tables.hpp"

#include "splinefeed/base/assertion.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr int attempts = 5;
// Of readings in search for two in a row that are equal. A line that spoils one of seven spoils every other one of six
// in 1.4 % of all cases, of 21 in one of 10^7.
constexpr int readings = 21;
constexpr std::uint64_t patience_us = 1'500'000; // a busy drive or computer may be late many times in a row
constexpr std::size_t most_registers = pvt::identity_registers;

} // namespace

template <class Attempt>
bool PvtTables::retry(const Attempt& attempt) noexcept {
    const std::uint64_t began_us = link_->clock().now_us();
    int failed = 0;
    while (failed < attempts) {
        if (!link_->connected() && !link_->connect()) {
            ++failed;
            continue;
        }
        const LinkAnswer answer = attempt();
        report_->count(answer);
        if (answer.ok()) {
            return true;
        }
        const bool waits = answer.fault == LinkFault::timeout && link_->clock().now_us() - began_us < patience_us;
        failed += waits ? 0 : 1;
    }
    return false;
}

DriveProblem PvtTables::no_answer(DriveProblem refused) const noexcept {
    return report_->last_fault == LinkFault::exception ? refused : DriveProblem::silent;
}

DriveProblem PvtTables::read(int address, std::span<std::uint16_t> registers, DriveProblem refused) noexcept {
    SPLINEFEED_ASSERT(registers.size() <= most_registers);
    std::array<std::uint16_t, most_registers> reading{};
    const std::span<std::uint16_t> latest = std::span(reading).first(registers.size());
    for (int i = 0; i < readings; ++i) {
        if (!retry([&] { return link_->read(unit_, address, latest); })) {
            return no_answer(refused);
        }
        if (i > 0 && std::ranges::equal(latest, registers)) {
            return DriveProblem::none;
        }
        std::ranges::copy(latest, registers.begin());
    }
    return DriveProblem::damaged;
}

DriveProblem PvtTables::write(int address, std::span<const std::uint16_t> registers) noexcept {
    std::array<std::uint16_t, most_registers> reading{};
    const std::span<std::uint16_t> kept = std::span(reading).first(registers.size());
    for (int i = 0; i < attempts; ++i) {
        if (!retry([&] { return link_->write(unit_, address, registers); })) {
            return no_answer(DriveProblem::refused);
        }
        if (const DriveProblem problem = read(address, kept, DriveProblem::refused); problem != DriveProblem::none) {
            return problem;
        }
        if (std::ranges::equal(kept, registers)) {
            return DriveProblem::none;
        }
    }
    return DriveProblem::not_kept;
}

DriveProblem PvtTables::read_status(int axes, PvtStatus& status) noexcept {
    std::array<std::uint16_t, pvt::status_registers(max_axes)> raw{};
    const std::span<std::uint16_t> whole = std::span(raw).first(pvt::status_registers(axes));
    for (int i = 0; i < attempts; ++i) {
        if (!retry([&] { return link_->read(unit_, pvt::status_address, whole); })) {
            return DriveProblem::silent;
        }
        if (status_holds(whole)) {
            status = decode_status(whole, axes);
            return DriveProblem::none;
        }
    }
    return DriveProblem::damaged;
}

} // namespace splinefeed::hal::modbus
