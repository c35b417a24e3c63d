// SPDX-License-Identifier: MIT
#include "host_sim/output/segment_output.hpp"

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s5_pulse_train/any_pulse_train.hpp"

#include "host_sim/config/step_lines.hpp"

#include <array>
#include <string>

namespace splinefeed::host {

namespace {

/// `#` lines with the units, a header `index,duration_ticks,<axis>_start,<axis>_end,<axis>_v_start,<axis>_v_end,...`,
/// one row a segment. No allocation per row.
class SegmentWriter final : public SegmentOutput {
public:
    SegmentWriter(OutputFile& file, const MachineDescription& machine)
        : file_(&file), axes_(static_cast<unsigned>(machine.settings.axes)) {
        file.append("# Each row is a cubic in time for each axis, given by position and velocity at both ends.\n");
        file.format("# duration_ticks: 1 tick = 1/{} us = {} s.\n", ticks_per_us, 1e-6 / ticks_per_us);
        for (unsigned k = 0; k < axes_; ++k) {
            const double steps_per_mm = machine.settings.axis[k].steps_per_mm;
            const std::string& name = machine.axis_name[k];
            file.format(
                "# {0}_start, {0}_end: position in units of 1/{1} count; {2} counts per mm; 1 unit = {3:.17g} mm.\n",
                name, units_per_count, steps_per_mm, 1.0 / (static_cast<double>(units_per_count) * steps_per_mm));
            file.format(
                "# {0}_v_start, {0}_v_end: velocity in the same units per duration of the segment; velocity in mm/s = "
                "value * {1:.17g} / duration_ticks.\n",
                name, ticks_per_us * 1e6 / (static_cast<double>(units_per_count) * steps_per_mm));
        }
        file.append("index,duration_ticks");
        for (unsigned k = 0; k < axes_; ++k) {
            file.format(",{0}_start,{0}_end,{0}_v_start,{0}_v_end", machine.axis_name[k]);
        }
        file.append("\n");
    }

    void segment(const FeedSegment& segment) override {
        file_->format("{},{}", segment.index, segment.duration_ticks);
        for (unsigned k = 0; k < axes_; ++k) {
            file_->format(",{},{},{},{}", segment.start[k], segment.end[k], segment.start_velocity[k],
                          segment.end_velocity[k]);
        }
        file_->append("\n");
    }

private:
    OutputFile* file_;
    unsigned axes_;
};

/// A header `t_ns,axis,line,value`, one row an edge, in order of time; t = 0 is the start of the first feed segment.
/// Each motor of an axis has its rows: the second one's axis is named with a 2 behind. No allocation per row.
class EdgeWriter final : public SegmentOutput {
public:
    /// Throws InputError if the lines cannot carry the machine's limits (step_lines.hpp).
    EdgeWriter(OutputFile& file, const MachineDescription& machine)
        : file_(&file), train_(make_pulse_train(machine.settings.axes, checked_step_timing(machine))),
          motors_(machine.motors) {
        for (const unsigned k : indices(machine.settings.axes)) {
            name_[k] = {machine.axis_name[k], machine.axis_name[k] + "2"};
        }
        file.append("t_ns,axis,line,value\n");
    }

    void segment(const FeedSegment& segment) override {
        std::visit([&](auto& train) { train.take(segment); }, train_);
        drain();
    }

    void finish() override {
        std::visit([](auto& train) { train.finish(); }, train_);
        drain();
    }

private:
    void drain() {
        std::visit(
            [this](auto& train) {
                Edge edge;
                while (train.next(edge)) {
                    row(edge);
                }
            },
            train_);
    }

    void row(const Edge& edge) {
        constexpr std::int64_t tick_ns = 1000 / ticks_per_us;
        const StepMotors& motors = motors_[edge.axis];
        for (const unsigned i : indices(motors.count)) {
            const bool step = edge.line == Line::step;
            const bool inverted = step ? motors.invert_step : motors.invert_direction[i];
            file_->format("{},{},{},{}\n", edge.tick * tick_ns, name_[edge.axis][i], step ? "step" : "dir",
                          edge.level != inverted ? 1 : 0);
        }
    }

    OutputFile* file_;
    AnyPulseTrain train_;
    PerAxis<StepMotors> motors_;
    PerAxis<std::array<std::string, 2>> name_{};
};

template <class Writer>
std::unique_ptr<SegmentOutput> make_output(OutputFile& file, const MachineDescription& machine) {
    return std::make_unique<Writer>(file, machine);
}

/// One row per output: a new one adds its own.
constexpr std::array segment_kinds{
    SegmentOutputKind{"--segments", "S.csv: the feed segments, in integers", make_output<SegmentWriter>},
    SegmentOutputKind{"--edges",
                      "E.csv: edges of the step and direction lines, on a virtual clock; docs/reference/files.md",
                      make_output<EdgeWriter>},
};

} // namespace

std::span<const SegmentOutputKind> segment_output_kinds() noexcept {
    return segment_kinds;
}

} // namespace splinefeed::host
