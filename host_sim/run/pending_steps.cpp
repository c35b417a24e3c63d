// SPDX-License-Identifier: MIT
#include "host_sim/run/pending_steps.hpp"

#include <cmath>
#include <utility>

namespace splinefeed::host {

// Rows are counted modulo 2^32, and the machine is less than 2^31 of them ahead.
const PendingStep* PendingSteps::passed(std::uint32_t row) const noexcept {
    if (steps_.empty()) {
        return nullptr;
    }
    const PendingStep& first = steps_.front();
    return !first.row || static_cast<std::int32_t>(row - *first.row - first.short_rows) > 0 ? &first : nullptr;
}

const PendingStep* PendingSteps::reached(std::optional<std::uint32_t> row, const PerAxis<double>& position_mm,
                                         int axes) const noexcept {
    if (steps_.empty()) {
        return nullptr;
    }
    const PendingStep& first = steps_.front();
    if (row.has_value() != first.row.has_value() || (row && *row - *first.row > first.short_rows)) {
        return nullptr;
    }
    for (unsigned k = 0; row && k < static_cast<unsigned>(axes); ++k) {
        if (!(std::fabs(position_mm[k] - to_mm(first.place[k])) < same_place_mm)) {
            return nullptr;
        }
    }
    return &first;
}

PendingStep PendingSteps::take() {
    PendingStep first = std::move(steps_.front());
    steps_.pop_front();
    return first;
}

} // namespace splinefeed::host
