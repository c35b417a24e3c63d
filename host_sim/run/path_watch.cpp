// SPDX-License-Identifier: MIT
#include "host_sim/run/path_watch.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

void PathWatch::segment(const CurveSegment<double>& segment, std::uint32_t row, const PathFeeder& feeder) {
    if (observers_.limits != nullptr) {
        if (const auto violation = observers_.limits->violation(segment)) {
            const std::uint64_t line = feeder.line_of_row(row);
            throw TravelError(*file_, line,
                              line > 0 ? *violation
                                       : fmt::format("on the way to {}: {}", feeder.name_of_row(row), *violation));
        }
    }
    if (observers_.error != nullptr) {
        observers_.error->segment(segment);
    }
    if (observers_.writer != nullptr) {
        observers_.writer->segment(segment);
    }
    if (observers_.work != nullptr) {
        observers_.work->add([this, segment] { measure(segment); });
    } else {
        measure(segment);
    }
    if (observers_.share != nullptr) {
        observers_.share->programmed(row, segment.block_feed_mm_s(), segment.feed_mm_s < 0.0);
    }
}

void PathWatch::measure(const CurveSegment<double>& segment) const {
    if (observers_.deviation != nullptr) {
        observers_.deviation->segment(segment);
    }
    if (observers_.optimum != nullptr) {
        observers_.optimum->segment(segment);
    }
}

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
    if (record_ != nullptr && pushed.stops) {
        record_->stop();
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
