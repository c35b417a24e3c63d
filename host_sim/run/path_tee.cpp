// SPDX-License-Identifier: MIT
#include "host_sim/run/path_tee.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/curve/segment_cast.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

template <Scalar S>
Pull PathTee<S>::next(CurveSegment<S>& out) noexcept {
    if (failure_) {
        return Pull::finished;
    }
    const Pull pull = feeder_->source().next(out);
    if (pull == Pull::item) {
        try {
            look(out);
        } catch (...) {
            failure_ = std::current_exception();
            return Pull::finished;
        }
    }
    return pull;
}

template <Scalar S>
void PathTee<S>::look(CurveSegment<S>& segment) {
    const CurveSegment<double>& seen = in_double(segment);
    const std::uint32_t index = segment.waypoint;
    const std::uint32_t row = feeder_->row_of(index);
    if (observers_.limits != nullptr) {
        if (const auto violation = observers_.limits->violation(seen)) {
            const std::uint64_t line = feeder_->line_of_row(row);
            throw InputError(*file_, line,
                             line > 0 ? *violation
                                      : fmt::format("on the way to {}: {}", feeder_->name_of_row(row), *violation));
        }
    }
    if (observers_.error != nullptr) {
        observers_.error->segment(seen);
    }
    if (observers_.deviation != nullptr) {
        observers_.deviation->segment(seen);
    }
    if (observers_.writer != nullptr) {
        observers_.writer->segment(seen);
    }
    if (observers_.optimum != nullptr) {
        observers_.optimum->segment(seen);
    }
    if (observers_.share != nullptr) {
        observers_.share->programmed(row, seen.block_feed_mm_s());
    }
    segment.waypoint = row;
    ++segments_;
}

template class PathTee<double>;
template class PathTee<float>;
template class PathTee<Fixed>;

} // namespace splinefeed::host
