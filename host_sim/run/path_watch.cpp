// SPDX-License-Identifier: MIT
#include "host_sim/run/path_watch.hpp"

#include "host_sim/base/input_error.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

void PathWatch::segment(const CurveSegment<double>& segment, std::uint32_t row, const PathFeeder& feeder) {
    if (observers_.limits != nullptr) {
        if (const auto violation = observers_.limits->violation(segment)) {
            const std::uint64_t line = feeder.line_of_row(row);
            throw InputError(*file_, line,
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
        observers_.share->programmed(row, segment.block_feed_mm_s());
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

} // namespace splinefeed::host
