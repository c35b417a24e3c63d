// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/bus_rate.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr int reads = 20;
constexpr double margin = 1.6; // for repeated exchanges and other load of the host

// Response time of a drive: an exchange minus its frames and silences.
double work_us(PvtClient& drive, const LinkTiming& timing) noexcept {
    const LinkAddress& address = drive.link().address();
    // The round trip does not include the silence before the request.
    const double line = exchange_us(address, 0, pvt::status_registers(drive.axes())) - silence_us(address);
    double round_trips = 0.0;
    int answered = 0;
    for (int i = 0; i < reads; ++i) {
        const LinkAnswer answer = drive.probe();
        answered += answer.ok() ? 1 : 0;
        round_trips += answer.ok() ? static_cast<double>(answer.answered_us - answer.sent_us) : 0.0;
    }
    return answered > 0 ? std::max(round_trips / answered - line, 0.0) : timing.answer_us;
}

} // namespace

double least_segment_us(ModbusBus& bus, const LinkTiming& timing) noexcept {
    double sum = 0.0; // time for one segment on each drive
    for (const auto& drive : bus.drives()) {
        const double block =
            exchange_us(drive->link().address(), pvt::most_block_registers, pvt::status_registers(drive->axes()));
        sum += (work_us(*drive, timing) + block) / static_cast<double>(pvt::most_segments(drive->axes()));
    }
    return margin * sum;
}

} // namespace splinefeed::hal::modbus
