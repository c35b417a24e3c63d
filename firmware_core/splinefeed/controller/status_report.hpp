// SPDX-License-Identifier: MIT
// StatusReport: the machine's state in one line.
#pragma once

#include "splinefeed/controller/answer_text.hpp"
#include "splinefeed/controller/controlled_machine.hpp"
#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/controller/controller_state.hpp"
#include "splinefeed/controller/overrides.hpp"
#include "splinefeed/controller/setting_list.hpp"
#include "splinefeed/controller/spindle_orders.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

namespace splinefeed {

/// Values of x, y, z, and of a, b, c up to the last one that the machine has. So a column is a letter; those that it
/// lacks are 0. mm with three decimals, inches with four; angles are degrees with three.
void write_axes(const PerAxis<Decimal>& values, const ProgramSettings& program, bool inches, AnswerText& out) noexcept;
/// The offset of the program's coordinates of an axis: work system, G92 and tool.
[[nodiscard]] PerAxis<Decimal> offset_of(const WorkOffsets& offsets) noexcept;

/// What a report says, and what it says now and then: offsets in every thirtieth report, or tenth at rest, and after a
/// change; overrides likewise, in another report.
class StatusReport {
public:
    /// What is shown.
    struct Content {
        ControllerState state = ControllerState::idle;
        int part = 0; ///< of Hold and Door: 0 stands, 1 brakes, 3 (Door) starts again
        const MachineReading* reading = nullptr;
        const WorkOffsets* offsets = nullptr;
        const SpindleOrders* spindle = nullptr;
        SenderSettings sender{};
        Overrides overrides{};
        int free_moves = 0;
        std::size_t free_bytes = 0;
        std::uint32_t line = 0; ///< that is executed; 0: none
    };

    /// @param all  also what is said now and then
    void write(const Content& content, const ControllerSettings& settings, bool all, AnswerText& out) noexcept;
    /// The next reports have both.
    void refresh() noexcept { until_offsets_ = until_overrides_ = 0; }

private:
    static void write_inputs(std::uint32_t inputs, const ControllerSettings& settings, AnswerText& out) noexcept;

    int until_offsets_ = 0;
    int until_overrides_ = 0;
    PerAxis<Decimal> last_offset_{};
    Overrides last_overrides_{};
};

} // namespace splinefeed
