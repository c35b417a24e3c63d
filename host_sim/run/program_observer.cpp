// SPDX-License-Identifier: MIT
#include "host_sim/run/program_observer.hpp"

namespace splinefeed::host {

void ProgramObserver::see(const PathFeeder::Pushed& pushed) {
    if (writer_ != nullptr) {
        write(pushed, *writer_);
    }
    if (report_ != nullptr) {
        tell(pushed, *report_);
    }
    if (record_ != nullptr && pushed.start) {
        record_->start(pushed.position);
    }
    if (record_ != nullptr && pushed.move != nullptr) {
        record_->move(pushed.move->move, pushed.move->rapid, pushed.move->line);
    }
}

void ProgramObserver::write(const PathFeeder::Pushed& pushed, ElementWriter& writer) {
    if (pushed.start) {
        writer.start(pushed.position);
    }
    if (const SourceStep* const move = pushed.move) {
        const double feed = move->rapid ? 0.0 : move->move.feed_mm_s;
        writer.move({&move->move, move->rapid, feed, move->line});
    }
    if (const SourceStep* const step = pushed.step) {
        if (step->kind == StepKind::dwell) {
            writer.dwell(step->dwell_s, step->line);
        } else {
            writer.event(step->action, step->line);
        }
    }
}

void ProgramObserver::tell(const PathFeeder::Pushed& pushed, ProgramReport& report) {
    if (pushed.start) {
        report.start(pushed.position);
    }
    if (pushed.move != nullptr) {
        report.move(pushed.move->move, pushed.move->rapid, pushed.move->line);
    }
    const EventKind kind = pushed.step != nullptr ? pushed.step->action.kind : EventKind::message;
    if (pushed.step != nullptr && (kind == EventKind::tool_change || kind == EventKind::tool_set)) {
        report.tool(pushed.step->action.number);
    }
}

} // namespace splinefeed::host
