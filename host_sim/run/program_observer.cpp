// SPDX-License-Identifier: MIT
#include "host_sim/run/program_observer.hpp"

namespace splinefeed::host {

template <Scalar S>
void ProgramObserver<S>::see(const typename ElementFeeder<S>::Pushed& pushed) {
    if (writer_ != nullptr) {
        write(pushed, *writer_);
    }
    if (report_ != nullptr) {
        tell(pushed, *report_);
    }
}

template <Scalar S>
void ProgramObserver<S>::write(const typename ElementFeeder<S>::Pushed& pushed, ElementWriter& writer) {
    if (pushed.start) {
        writer.start(pushed.position);
    }
    if (const SourceStep<S>* const move = pushed.move) {
        const double feed = move->rapid ? 0.0 : move->programmed.feed_mm_s;
        writer.move({&move->programmed, move->rapid, feed, move->line});
    }
    if (const SourceStep<S>* const step = pushed.step) {
        if (step->kind == StepKind::dwell) {
            writer.dwell(step->dwell_s, step->line);
        } else {
            writer.event(step->action, step->line);
        }
    }
}

template <Scalar S>
void ProgramObserver<S>::tell(const typename ElementFeeder<S>::Pushed& pushed, ProgramReport& report) {
    if (pushed.start) {
        report.start(pushed.position);
    }
    if (pushed.move != nullptr) {
        report.move(pushed.move->programmed, pushed.move->rapid, pushed.move->line);
    }
    const EventKind kind = pushed.step != nullptr ? pushed.step->action.kind : EventKind::message;
    if (pushed.step != nullptr && (kind == EventKind::tool_change || kind == EventKind::tool_set)) {
        report.tool(pushed.step->action.number);
    }
}

template class ProgramObserver<double>;
template class ProgramObserver<float>;
template class ProgramObserver<Fixed>;

} // namespace splinefeed::host
