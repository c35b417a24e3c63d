// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/contour_element.hpp"

namespace splinefeed {

namespace {

constexpr std::int64_t smooth_sine = std::int64_t{1} << 44; // 3.8e-6: what the digits of a program leave
constexpr std::int64_t mild_sine = sine_one / 20;           // 0.05, LinuxCNC's
constexpr std::int64_t back_sine = std::int64_t{1} << 52;   // 0.001: the tool then comes nearer by 5e-7 of its radius
constexpr Decimal least_way{Decimal::one / 10'000'000};     // backwards by less is none [mm]
constexpr std::int64_t half_turn = Decimal::full_turn / 2;

Decimal angle_at(PlanePoint centre, PlanePoint point) noexcept {
    return angle_of(point.first - centre.first, point.second - centre.second);
}

// Within half a turn.
Decimal shortest(Decimal angle) noexcept {
    const std::int64_t turn = angle.raw > half_turn    ? -Decimal::full_turn
                              : angle.raw < -half_turn ? Decimal::full_turn
                                                       : 0;
    return {angle.raw + turn};
}

Decimal tool_radius(const ContourElement& element, PlanePoint at, CutterOffset offset) noexcept {
    const Decimal radius = plane_distance(element.centre, at);
    return element.holds_tool(offset.side) ? radius - offset.radius : radius + offset.radius;
}

// Above 0: it bends to the left.
std::int64_t curvature(const ContourElement& element) noexcept {
    const std::int64_t radius = plane_distance(element.centre, element.programmed_to).raw;
    return element.is_arc ? element.turn() * ((std::int64_t{1} << 62) / radius) : 0;
}

// Whether an element that turns back comes to lie where the tool was: beside a thin wall it would not.
bool makes_cusp(const ContourElement& before, const ContourElement& next, int side) noexcept {
    const std::int64_t apart = -curvature(next) - curvature(before);
    return side > 0 ? apart > 0 : apart < 0;
}

// An inner corner is where the tool first comes to the element; at an outer one the ways are extended.
Crossing crossing_of(const ContourElement& element, int side, bool is_inner) noexcept {
    return element.holds_tool(side) == is_inner ? Crossing::leaves : Crossing::enters;
}

// Two lines: back along the former one from beside the corner.
bool cross_lines(PlanePoint beside, PlaneDirection u, std::int64_t sine, std::int64_t cosine, Decimal radius,
                 PlanePoint& out) noexcept {
    const auto whole = static_cast<std::uint64_t>(sine_one + cosine);
    const detail::Checked back = product_quotient(radius.raw, sine, whole);
    if (!back.fits || detail::magnitude(back.raw) > static_cast<std::uint64_t>(largest_position.raw)) {
        return false;
    }
    out = moved(beside, u, {-back.raw});
    return true;
}

// Where the ways beside two elements cross. @param sine  above 0: towards the tool
bool find_meeting(const ContourElement& before, const ContourElement& next, CutterOffset offset, std::int64_t sine,
                  PlanePoint& out) noexcept {
    const PlanePoint corner = before.programmed_to;
    const PlaneDirection u = before.last_direction();
    const PlaneDirection v = next.first_direction();
    const PlanePoint beside_before = moved(corner, quarter_turned(u, offset.side), offset.radius);
    if (!before.is_arc && !next.is_arc) {
        return cross_lines(beside_before, u, sine, angle_between(u, v).cosine, offset.radius, out);
    }
    const bool is_inner = sine > 0;
    const Crossing of_next = crossing_of(next, offset.side, is_inner);
    if (!before.is_arc) {
        return cross_line(beside_before, u, next.centre, tool_radius(next, corner, offset), of_next, out);
    }
    const Decimal radius = tool_radius(before, corner, offset);
    if (!next.is_arc) { // from the line backwards
        const PlanePoint beside_next = moved(corner, quarter_turned(v, offset.side), offset.radius);
        return cross_line(beside_next, -v, before.centre, radius, crossing_of(before, offset.side, is_inner), out);
    }
    return cross_circle(before.centre, radius, before.turn(), next.centre, tool_radius(next, corner, offset), of_next,
                        out);
}

} // namespace

PlaneDirection ContourElement::first_direction() const noexcept {
    return is_arc ? quarter_turned(plane_direction(centre, programmed_from), turn())
                  : plane_direction(programmed_from, programmed_to);
}

PlaneDirection ContourElement::last_direction() const noexcept {
    return is_arc ? quarter_turned(plane_direction(centre, programmed_to), turn())
                  : plane_direction(programmed_from, programmed_to);
}

Decimal ContourElement::tool_sweep_deg() const noexcept {
    const Decimal begin = shortest(angle_at(centre, from) - angle_at(centre, programmed_from));
    const Decimal end = shortest(angle_at(centre, to) - angle_at(centre, programmed_to));
    return sweep_deg + end - begin;
}

bool ContourElement::fits() const noexcept {
    if (is_arc) {
        return tool_sweep_deg().raw == 0 || (tool_sweep_deg().raw < 0) == (sweep_deg.raw < 0);
    }
    return is_entry || along(from, to, first_direction()) >= -least_way;
}

ProgramResult<CornerPlace> find_corner(const ContourElement& before, const ContourElement& next,
                                       CutterOffset offset) noexcept {
    const PlaneDirection v = next.first_direction();
    const SineCosine angle = angle_between(before.last_direction(), v);
    const std::int64_t sine = offset.side > 0 ? angle.sine : -angle.sine; // above 0: towards the tool
    const std::int64_t size = sine < 0 ? -sine : sine;
    CornerPlace out{false, before.to};
    if (angle.cosine > 0 && size < smooth_sine) {
        return out;
    }
    const bool goes_back = angle.cosine < 0 && size < back_sine;
    const bool is_cusp = angle.cosine < 0 && size < mild_sine && makes_cusp(before, next, offset.side);
    const bool is_inner = is_cusp || (sine > 0 && !goes_back);
    const bool is_mild = angle.cosine > 0 && size < mild_sine;
    if ((is_inner || is_mild) && find_meeting(before, next, offset, is_cusp ? size | 1 : sine, out.tool_at)) {
        return out;
    }
    if (is_inner) {
        return ProgramError::cutter_gouge;
    }
    out.around = true;
    out.tool_at = moved(before.programmed_to, quarter_turned(v, offset.side), offset.radius);
    return out;
}

ProgramStatus offset_end(ContourElement& element, CutterOffset offset) noexcept {
    if (element.holds_tool(offset.side)) {
        const Decimal begin = plane_distance(element.centre, element.programmed_from);
        const Decimal end = plane_distance(element.centre, element.programmed_to);
        if (begin <= offset.radius || end <= offset.radius) {
            return ProgramError::cutter_arc_too_small;
        }
    }
    element.to = moved(element.programmed_to, quarter_turned(element.last_direction(), offset.side), offset.radius);
    return {};
}

// The centre lies on the line from the end of the tool's way to the programmed centre, as far from both ends.
ProgramStatus enter_by_arc(ContourElement& element, CutterOffset offset) noexcept {
    const PlaneDirection u = plane_direction(element.to, element.centre);
    const Decimal chord = plane_distance(element.to, element.from);
    const Decimal ahead = along(element.to, element.from, u);
    if (ahead.raw <= 0 || plane_distance(element.from, element.programmed_to) <= offset.radius) {
        return ProgramError::cutter_entry_too_short;
    }
    const detail::Checked radius = product_quotient(chord.raw, chord.raw, static_cast<std::uint64_t>(ahead.raw) * 2);
    const bool is_behind_corner = !element.holds_tool(offset.side) && radius.raw <= offset.radius.raw;
    if (!radius.fits || radius.raw > largest_position.raw || is_behind_corner) {
        return ProgramError::cutter_entry_too_short;
    }
    const std::int64_t turns = (static_cast<std::int64_t>(detail::magnitude(element.sweep_deg.raw)) - 1) /
                               Decimal::full_turn * Decimal::full_turn;
    element.centre = moved(element.to, u, {radius.raw});
    element.programmed_from = element.from;
    const Decimal way = angle_at(element.centre, element.to) - angle_at(element.centre, element.from);
    std::int64_t sweep = element.turn() * way.raw % Decimal::full_turn;
    sweep += sweep <= 0 ? Decimal::full_turn : 0;
    element.sweep_deg.raw = element.turn() * (sweep + turns);
    return {};
}

} // namespace splinefeed
