// SPDX-License-Identifier: MIT
#include "host_sim/output/edge_writer.hpp"

#include "host_sim/config/step_lines.hpp"

namespace splinefeed::host {

EdgeWriter::EdgeWriter(OutputFile& file, const MachineDescription& machine)
    : file_(&file), train_(make_pulse_train(machine.settings.axes, checked_step_timing(machine))),
      motors_(machine.motors) {
    for (const unsigned k : indices(machine.settings.axes)) {
        name_[k] = {machine.axis_name[k], machine.axis_name[k] + "2"};
    }
    file.append("t_ns,axis,line,value\n");
}

void EdgeWriter::segment(const FeedSegment& segment) {
    std::visit([&](auto& train) { train.take(segment); }, train_);
    drain();
}

void EdgeWriter::finish() {
    std::visit([](auto& train) { train.finish(); }, train_);
    drain();
}

void EdgeWriter::drain() {
    std::visit(
        [this](auto& train) {
            Edge edge;
            while (train.next(edge)) {
                row(edge);
            }
        },
        train_);
}

void EdgeWriter::row(const Edge& edge) {
    constexpr std::int64_t tick_ns = 1000 / ticks_per_us;
    const StepMotors& motors = motors_[edge.axis];
    for (const unsigned i : indices(motors.count)) {
        const bool step = edge.line == Line::step;
        const bool inverted = step ? motors.invert_step : motors.invert_direction[i];
        file_->format("{},{},{},{}\n", edge.tick * tick_ns, name_[edge.axis][i], step ? "step" : "dir",
                      edge.level != inverted ? 1 : 0);
    }
}

} // namespace splinefeed::host
