// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_standby.hpp"

#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"

namespace splinefeed::hal::modbus {

std::string SetpointStandby::poll_others(const SetpointDrive& but) {
    for (troubled_ = 0; troubled_ < drives_.size(); ++troubled_) {
        SetpointDrive& drive = *drives_[troubled_];
        if (&drive == &but) {
            continue;
        }
        static_cast<void>(drive.read_next());
        const DriveReading& reading = drive.reading();
        if (reading.state == DriveState::fault) {
            return fault_sentence(reading);
        }
        if (reading.state == DriveState::disabled) {
            return "it was disabled while another drive was prepared";
        }
        if (drive.link().clock().now_us() > drive.answered_us() + away_us_) {
            return silence(drive.last_answer(), &drive.link());
        }
    }
    return {};
}

} // namespace splinefeed::hal::modbus
