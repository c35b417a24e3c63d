// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/cutter_path.hpp"

namespace splinefeed {

ProgramStatus CutterPath::plan_element(const ContourElement& next, CutterOffset offset) noexcept {
    plan_.next = next;
    plan_.next.is_entry = !entered_ && !next.is_arc;
    plan_.corner = {};
    plan_.offset = offset;
    if (const ProgramStatus status = offset_end(plan_.next, offset); !status.ok()) {
        return status;
    }
    plan_.has_element = true;
    if (!entered_ && next.is_arc) {
        return enter_by_arc(plan_.next, offset);
    }
    if (!entered_) {
        const bool is_long = plane_distance(next.from, next.programmed_to) > offset.radius;
        return is_long ? ProgramStatus{} : ProgramError::cutter_entry_too_short;
    }
    const ProgramResult<CornerPlace> corner = find_corner(last_, plan_.next, offset);
    if (!corner.has_value()) {
        return corner.error();
    }
    plan_.corner = *corner;
    plan_.next.from = corner->tool_at;
    ContourElement before = last_;
    before.to = corner->around ? before.to : corner->tool_at;
    return before.fits() ? ProgramStatus{} : ProgramError::cutter_gouge;
}

ProgramStatus CutterPath::check_end() const noexcept {
    const bool fits = plan_.has_element ? plan_.next.fits() : !entered_ || last_.fits();
    return fits ? ProgramStatus{} : ProgramError::cutter_gouge;
}

ProgramStatus CutterPath::plan_end() noexcept {
    plan_.ends = true;
    return check_end();
}

void CutterPath::keep_plan() noexcept {
    if (plan_.has_element) {
        corner_ = plan_.corner;
        offset_ = plan_.offset;
        last_.to = entered_ && !corner_.around ? corner_.tool_at : last_.to;
        release();
        last_ = plan_.next;
    } else if (plan_.ends) {
        release();
    }
    entered_ = plan_.has_element || (entered_ && !plan_.ends);
    plan_ = {};
}

void CutterPath::release() noexcept {
    leaving_ = last_;
    releasing_ = count_ > 0;
}

void CutterPath::leave() noexcept {
    entered_ = false;
    release();
}

const CutterPath::Item& CutterPath::give() noexcept {
    const Item& item = items_[given_++];
    if (given_ == count_) {
        given_ = count_ = 0;
        releasing_ = false;
    }
    return item;
}

} // namespace splinefeed
