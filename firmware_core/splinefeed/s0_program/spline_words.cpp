// SPDX-License-Identifier: MIT
// BlockInterpreter: G5, G5.1, G5.2, G5.3 and G5.5.
#include "splinefeed/s0_program/block_interpreter.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

#include <algorithm>

namespace splinefeed {

namespace {

constexpr std::uint32_t other_axes = Block::bits("zabcuvw");
constexpr Decimal longest_spline = Decimal::from_integer(65536);
constexpr Decimal longest_leg = Decimal::from_integer(8192); // so that a path takes what a curve makes of it
constexpr Decimal heaviest = Decimal::from_integer(1000000);

// As far from `end` as a curve of the core needs for a direction: towards the first point that is elsewhere.
void leave_end(SpacePoint& inner, const SpacePoint& end, const SpacePoint& next, const SpacePoint& last) noexcept {
    const SpacePoint& toward = next != end ? next : last;
    Decimal way{}; // the longest part of it, and of all the curve
    Decimal whole{};
    for (unsigned k = 0; k < 3; ++k) {
        const auto size = [](Decimal value) {
            return value.raw < 0 ? -value : value;
        };
        way = std::max(way, size(toward[k] - end[k]));
        whole = std::max({whole, size(next[k] - end[k]), size(last[k] - end[k])});
    }
    if (way.raw == 0) {
        return;
    }
    const auto part = std::min(whole.raw / 8192, way.raw / 2);
    for (unsigned k = 0; k < 3; ++k) {
        inner[k] =
            end[k] + Decimal{product_quotient((toward[k] - end[k]).raw, part, static_cast<std::uint64_t>(way.raw)).raw};
    }
}

// An inner control point on its end leaves it without a direction.
void give_directions(BezierPlan& cubic) noexcept {
    auto& p = cubic.points;
    const std::array<SpacePoint, 4> given{p[0], p[1], p[2], p[3]};
    if (given[1] == given[0]) {
        leave_end(p[1], given[0], given[2], given[3]);
    }
    if (given[2] == given[3]) {
        leave_end(p[2], given[3], given[1], given[0]);
    }
}

} // namespace

// The inner control points are offsets in the plane from the start (I, J) and from the end (P, Q).
BlockStatus BlockInterpreter::plan_spline(const ModalState& before) noexcept {
    const int x = letters_.index('x');
    const int y = letters_.index('y');
    if (modal_.plane != Plane::xy || x < 0 || y < 0) {
        return block_.at(ProgramError::spline_plane, CodeGroup::motion);
    }
    if (block_.has_any(other_axes)) {
        return block_.at(ProgramError::spline_axis_word, CodeGroup::motion);
    }
    const bool cubic = modal_.motion == 50;
    const bool goes_on = cubic && before.motion == 50;
    const bool has_start = block_.has('i') && block_.has('j');
    if (block_.has('i') != block_.has('j') || (!has_start && !goes_on)) {
        return block_.at(ProgramError::spline_offset_missing, CodeGroup::motion);
    }
    if (cubic && !(block_.has('p') && block_.has('q'))) {
        return block_.at(ProgramError::spline_end_missing, CodeGroup::motion);
    }
    const PlanePoint start = has_start ? PlanePoint{modal_.in_mm(block_.value('i')), modal_.in_mm(block_.value('j'))}
                                       : PlanePoint{-results_.spline_out.first, -results_.spline_out.second};
    if (!cubic && start.first.raw == 0 && start.second.raw == 0) {
        return block_.at(ProgramError::spline_offset_missing, 'i');
    }
    const Place end = find_end();
    const auto i = static_cast<unsigned>(x);
    const auto j = static_cast<unsigned>(y);
    const auto at = [&](const AxisPoint& base, PlanePoint offset) {
        AxisPoint point = base;
        point[i] += offset.first;
        point[j] += offset.second;
        return space(frame_.to_machine(point));
    };
    BezierPlan& spline = series_.emplace<BezierPlan>();
    spline.degree = cubic ? 3 : 2;
    spline.points[0] = space(place_.machine);
    spline.points[1] = at(place_.program, start);
    if (cubic) {
        results_.spline_out = {modal_.in_mm(block_.value('p')), modal_.in_mm(block_.value('q'))};
        spline.points[2] = at(end.program, results_.spline_out);
    }
    spline.points[static_cast<unsigned>(spline.degree)] = space(end.machine);
    if (cubic) {
        give_directions(spline);
    }
    plan_.kind = PlanKind::bezier;
    for (unsigned n = 1; n < static_cast<unsigned>(spline.degree); ++n) {
        for (unsigned k = 0; k < 3; ++k) {
            const Decimal way = spline.points[n][k] - spline.points[0][k];
            if (way > longest_spline || way < -longest_spline) {
                return block_.at(ProgramError::move_too_long, CodeGroup::motion);
            }
        }
    }
    return move_to(end);
}

BlockStatus BlockInterpreter::plan_nurbs() noexcept {
    const int x = letters_.index('x');
    const int y = letters_.index('y');
    if (modal_.plane != Plane::xy || x < 0 || y < 0) {
        return block_.at(ProgramError::spline_plane, CodeGroup::motion);
    }
    if (block_.has_any(other_axes)) {
        return block_.at(ProgramError::spline_axis_word, CodeGroup::motion);
    }
    const bool fresh = !nurbs_.is_open();
    const bool has_point = block_.has('x') && block_.has('y');
    if (block_.has('x') != block_.has('y') || (!has_point && !fresh)) {
        return block_.at(ProgramError::nurbs_word, CodeGroup::motion);
    }
    const Decimal weight = block_.has('p') ? block_.value('p') : Decimal{Decimal::one};
    if (weight.raw < Decimal::one / 1000000 || weight > heaviest || (!fresh && !nurbs_.accepts(weight))) {
        return block_.at(ProgramError::nurbs_weight_invalid, 'p');
    }
    std::int32_t order = fresh ? NurbsCurve::least_order : nurbs_.order();
    if (block_.has('l') && (!to_integer(block_.value('l'), order) || order < NurbsCurve::least_order ||
                            order > NurbsCurve::most_order || (!fresh && order != nurbs_.order()))) {
        return block_.at(ProgramError::nurbs_order_invalid, 'l');
    }
    if (fresh) {
        series_.emplace<BezierPlan>();
        nurbs_.begin(order, space(place_.machine), has_point ? Decimal{Decimal::one} : weight);
    }
    plan_.kind = PlanKind::nurbs;
    plan_.to = place_.machine;
    if (!has_point) {
        return {};
    }
    // As in LinuxCNC, G91 counts from the start of the curve: the program stands there until G5.3.
    const Place end = find_end();
    if (const BlockStatus status = check_reach(end.machine); !status.ok()) {
        return status;
    }
    if (!nurbs_.accepts(weight)) {
        return block_.at(ProgramError::nurbs_weight_invalid, 'p');
    }
    nurbs_.add(space(end.machine), weight);
    return {};
}

BlockStatus BlockInterpreter::end_nurbs() noexcept {
    if (!nurbs_.is_open()) {
        return block_.at(ProgramError::nurbs_not_begun, CodeGroup::non_modal);
    }
    if (block_.has(CodeGroup::motion) || block_.has_any(Block::bits("xyzabcuvwlp"))) {
        return block_.at(ProgramError::nurbs_word, CodeGroup::non_modal);
    }
    if (!nurbs_.finish()) {
        return block_.at(ProgramError::nurbs_too_few_points, CodeGroup::non_modal);
    }
    const SpacePoint last = nurbs_.last();
    AxisPoint machine = place_.machine;
    machine[letters_.place('x')] = last[0];
    machine[letters_.place('y')] = last[1];
    plan_.kind = PlanKind::nurbs;
    modal_.motion = ModalState::no_motion;
    place_ = {frame_.to_program(machine), machine};
    plan_.to = machine;
    return {};
}

BlockStatus BlockInterpreter::plan_point() noexcept {
    if (!takes_points_) {
        return block_.at(ProgramError::points_unsupported, CodeGroup::motion);
    }
    if (modal_.inverse_time) {
        return block_.at(ProgramError::points_inverse_time, CodeGroup::motion);
    }
    const Place end = find_end();
    for (int k = 0; k < letters_.count(); ++k) {
        const Decimal way = end.machine[static_cast<unsigned>(k)] - place_.machine[static_cast<unsigned>(k)];
        if (way > longest_leg || way < -longest_leg) {
            return block_.at(ProgramError::points_too_far, has_axis(k) ? letters_.letter(k) : ' ');
        }
    }
    plan_.kind = PlanKind::point;
    return move_to(end);
}

// Whether a curve through points goes on in the block, which has been planned: it states a point, or modes that have no
// place on the path. M0 and M2 beside a point end it behind that.
bool BlockInterpreter::leaves_curve_open() noexcept {
    for (unsigned group = 0; group < code_groups; ++group) {
        const auto code = static_cast<CodeGroup>(group);
        const bool goes_on = code == CodeGroup::motion || code == CodeGroup::distance || code == CodeGroup::units ||
                             code == CodeGroup::centre_distance || code == CodeGroup::feed_mode ||
                             code == CodeGroup::plane || code == CodeGroup::retract ||
                             (code == CodeGroup::stop && plan_.kind == PlanKind::point);
        if (block_.has(code) && !goes_on) {
            return false;
        }
    }
    const bool has_event = block_.has_any(Block::bits("st")) || block_.comment() != CommentKind::none;
    return modal_.motion == 55 && !has_event && (plan_.kind == PlanKind::none || plan_.kind == PlanKind::point);
}

} // namespace splinefeed
