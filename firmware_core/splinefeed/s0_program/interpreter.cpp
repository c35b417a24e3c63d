// SPDX-License-Identifier: MIT
//
// The feed of a move is along x, y, z, as in LinuxCNC: along u, v, w where those do not move, along a, b, c (in
// degrees) where neither does. In some dialects it is along all of them. The core's feed is along the path in all axes,
// so that a move takes the same time it is
//     F * (length in all axes) / (length that F counts).
// An F in inches is one in degrees, too: a degree counts as an inch.
#include "splinefeed/s0_program/interpreter.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

#include <utility>

namespace splinefeed {

namespace {

constexpr double slowest_mm_s = 0.001;
constexpr double fastest_mm_s = 10000.0;

template <Scalar S>
S clamped(S feed) noexcept {
    return smaller(larger(feed, literal<S>(slowest_mm_s)), literal<S>(fastest_mm_s));
}

// a * b where that is at most `most`, else `most`; none is negative.
template <Scalar S>
S product_up_to(S a, S b, S most) noexcept {
    return b > S{} && a > quotient_or_max(most, b) ? most : a * b;
}

template <Scalar S>
S scalar_of_q32(std::int64_t raw) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return Fixed::from_raw(raw);
    } else {
        return detail::from_integer_scaled<S>(raw, -32);
    }
}

template <Scalar S>
S length_mm(Decimal from, Decimal to) noexcept {
    return absolute(distance<S>(to_position(from), to_position(to), 0));
}

// Not used where the largest degree is 3.
[[maybe_unused]] bool with_motion(EventKind kind) noexcept {
    return kind == EventKind::output_on_with_motion || kind == EventKind::output_off_with_motion ||
           kind == EventKind::analog_output_with_motion;
}

} // namespace

template <Scalar S>
Pull Interpreter<S>::next(ProgramItem<S>& out) noexcept {
    if (in_pieces_) {
        fill_piece(out);
        return Pull::item;
    }
    ProgramStep step;
    for (;;) {
        while (gives_curve()) {
            if (give_curve(out)) {
                return Pull::item;
            }
        }
        if (!has_steps()) {
            return has_ended() ? Pull::finished : Pull::starved;
        }
        const Pull pull = next_step(step, out.event);
        if (pull != Pull::item) {
            return pull;
        }
        if (!step.is_point) {
            break;
        }
        add_point(step);
        step = {};
    }
    out.kind = step.kind;
    out.line = line();
    out.stops_before = step.stops_before;
    if (step.kind == ItemKind::event) {
        ends_chain_ = ends_chain_ || with_motion(out.event.kind);
    } else if (step.kind == ItemKind::move) {
        fill_move(step, out);
        begin_chain(out.element);
        if (step.shape == MoveShape::bezier && step.bezier->rational) {
            pieces_.begin(*step.bezier);
            in_pieces_ = true;
            pieces_begun_ = false;
            piece_end_ = {};
            for (const unsigned k : indices(letters().count())) {
                piece_end_[k] = to_position(step.from[k]);
            }
            pieces_to_ = step.to;
            pieces_feed_ = out.element.feed_mm_s;
            fill_piece(out);
        }
    } else if (step.kind == ItemKind::dwell) {
        out.dwell_s = step.dwell_s;
    }
    return Pull::item;
}

// Within a curve of several moves the place of an event before this one would be lost.
template <Scalar S>
void Interpreter<S>::begin_chain(PathElement<S>& element) noexcept {
    if (std::exchange(ends_chain_, false)) {
        element.chain_tolerance_mm = S{};
    }
}

template <Scalar S>
void Interpreter<S>::fill_manner(const MoveManner& how, MoveKind move, ProgramItem<S>& out) const noexcept {
    out.kind = ItemKind::move;
    out.line = line();
    out.move = move;
    out.inverse_time = how.inverse_time;
    out.feed = how.feed;
    PathElement<S>& element = out.element;
    element.mode = how.mode;
    element.joined = false;
    element.max_feed_mm_s = S{};
    const bool blends = how.mode == PathMode::continuous;
    const bool rapid = move == MoveKind::rapid || move == MoveKind::home;
    element.tolerance_mm = !blends ? S{} : to_scalar<S>(rapid ? rapid_tolerance() : how.tolerance_mm);
    element.chain_tolerance_mm = rapid ? element.tolerance_mm : to_scalar<S>(how.chain_tolerance_mm);
}

template <Scalar S>
void Interpreter<S>::fill_move(const ProgramStep& step, ProgramItem<S>& out) const noexcept {
    fill_manner(manner(), step.move, out);
    out.probe = step.probe;
    out.home_axes = step.home_axes;
    PathElement<S>& element = out.element;
    element.shape = step.shape;
    element.stop_at_end = step.stop_at_end;
    element.joined = step.joined;
    for (const unsigned k : indices(letters().count())) {
        element.to[k] = to_position(step.to[k]);
    }
    if (step.shape == MoveShape::arc) {
        fill_arc(step, out);
    } else if (step.shape == MoveShape::bezier && !step.bezier->rational) {
        fill_bezier(step, out);
    }
    const bool rapid = step.move == MoveKind::rapid || step.move == MoveKind::home;
    element.feed_mm_s = rapid ? S{} : path_feed(step);
}

template <Scalar S>
void Interpreter<S>::fill_arc(const ProgramStep& step, ProgramItem<S>& out) const noexcept {
    ArcShape<S>& arc = out.element.arc;
    arc.centre = {};
    arc.normal = {};
    const std::array<int, 3> axes{letters().index('x'), letters().index('y'), letters().index('z')};
    for (unsigned k = 0; k < 3; ++k) {
        if (axes[k] >= 0) {
            arc.centre[static_cast<unsigned>(axes[k])] = to_position(step.arc->centre[k]);
        }
    }
    // The normal in x, y, z of the machine, by the rotation of the work system.
    const SineCosine& turn = frame().rotation();
    std::array<std::int64_t, 3> normal{};
    switch (step.arc->plane) {
    case Plane::yz: normal = {turn.cosine, turn.sine, 0}; break;
    case Plane::zx: normal = {-turn.sine, turn.cosine, 0}; break;
    case Plane::xy: normal = {0, 0, sine_one}; break;
    }
    // Axes in another order than x, y, z: the core's frame is left-handed if the order is odd.
    const std::array<int, 3> places = letters().space_places();
    const bool odd = (places[1] - places[0] + 3) % 3 != 1;
    for (unsigned k = 0; k < 3; ++k) {
        const std::int64_t value = odd ? -normal[k] : normal[k];
        arc.normal[static_cast<unsigned>(places[k])] =
            scalar_of_q32<S>((value + (std::int64_t{1} << 29)) >> (sine_bits - 32));
    }
    arc.sweep_rad = scalar_of_q32<S>(radians_q32(step.arc->sweep_deg));
}

template <Scalar S>
void Interpreter<S>::fill_bezier(const ProgramStep& step, ProgramItem<S>& out) const noexcept {
    BezierShape<S>& bezier = out.element.bezier;
    bezier.degree = step.bezier->degree;
    bezier.points = {};
    for (unsigned k = 0; k < 3; ++k) {
        const int axis = letters().index("xyz"[k]);
        if (axis < 0) {
            continue;
        }
        const Position from = to_position(step.from[static_cast<unsigned>(axis)]);
        for (unsigned i = 1; i <= static_cast<unsigned>(bezier.degree); ++i) {
            bezier.points[static_cast<unsigned>(axis)][i] =
                distance<S>(from, to_position(step.bezier->points[i][k]), chord_unit_log2);
        }
    }
}

// A quintic of a rational piece.
template <Scalar S>
void Interpreter<S>::fill_piece(ProgramItem<S>& out) noexcept {
    std::array<std::array<S, 6>, 3> points;
    pieces_.next(points);
    const bool first = !pieces_begun_;
    pieces_begun_ = true;
    if (!first) {
        fill_manner(manner(), MoveKind::feed, out);
        out.stops_before = false;
    }
    PathElement<S>& element = out.element;
    element.shape = MoveShape::bezier;
    element.joined = !first;
    element.stop_at_end = false;
    element.feed_mm_s = pieces_feed_;
    element.bezier.degree = 5;
    element.bezier.points = {};
    in_pieces_ = !pieces_.is_done();
    if (in_pieces_ && element.mode == PathMode::exact_stop) { // the move ends with its last piece
        element.mode = PathMode::exact_path;
    }
    for (unsigned k = 0; k < 3; ++k) {
        const int axis = letters().index("xyz"[k]);
        if (axis < 0) {
            continue;
        }
        const auto n = static_cast<unsigned>(axis);
        for (unsigned i = 0; i < 6; ++i) {
            element.bezier.points[n][i] = points[k][i];
        }
        piece_end_[n] =
            in_pieces_ ? displaced(piece_end_[n], points[k][5], chord_unit_log2) : to_position(pieces_to_[n]);
    }
    element.to = piece_end_;
}

template <Scalar S>
void Interpreter<S>::add_point(const ProgramStep& step) noexcept {
    typename PointCurve<S>::Point point{{}, path_feed(step), manner().feed, line()};
    PerAxis<Position> from{};
    for (const unsigned k : indices(letters().count())) {
        from[k] = to_position(step.from[k]);
        point.to[k] = to_position(step.to[k]);
    }
    if (curve_ == CurveState::none) {
        points_->begin(from, manner(), letters().count());
    }
    points_->add(point);
    curve_ = CurveState::gives;
}

// The next move of the curve. false: there is none now
template <Scalar S>
bool Interpreter<S>::give_curve(ProgramItem<S>& out) noexcept {
    if (curve_ == CurveState::ends) {
        points_->finish();
    }
    fill_manner(points_->manner(), MoveKind::feed, out);
    out.stops_before = false;
    if (points_->next(out)) {
        begin_chain(out.element);
        return true;
    }
    curve_ = curve_ == CurveState::ends ? CurveState::none : stops_behind() ? CurveState::ends : CurveState::open;
    return false;
}

// How long the move is in x, y and z. [mm]
template <Scalar S>
S Interpreter<S>::space_length(const ProgramStep& step) const noexcept {
    const std::array<int, 3> axes{letters().index('x'), letters().index('y'), letters().index('z')};
    std::array<S, 3> way{};
    for (unsigned k = 0; k < 3; ++k) {
        if (axes[k] >= 0) {
            const auto n = static_cast<unsigned>(axes[k]);
            way[k] = length_mm<S>(step.from[n], step.to[n]);
        }
    }
    if (step.shape == MoveShape::bezier) { // between its chord and its polygon
        S polygon{};
        for (const unsigned i : indices(step.bezier->degree)) {
            std::array<S, 3> leg{};
            for (unsigned k = 0; k < 3; ++k) {
                leg[k] = length_mm<S>(step.bezier->points[i][k], step.bezier->points[i + 1][k]);
            }
            polygon += norm(leg, 3);
        }
        return scale2(polygon + norm(way, 3), -1);
    }
    if (step.shape == MoveShape::arc) {
        const auto normal = static_cast<unsigned>(step.arc->plane);
        std::array<S, 3> arm{};
        for (unsigned k = 0; k < 3; ++k) {
            if (axes[k] >= 0) {
                arm[k] = length_mm<S>(step.arc->centre[k], step.from[static_cast<unsigned>(axes[k])]);
            }
        }
        // The centre is on the level of the start, so the arm lies in the plane; the rise is across it.
        const S rise = axes[normal] >= 0 && (normal == 2 || !frame().is_turned()) ? way[normal] : S{};
        const S angle = absolute(scalar_of_q32<S>(radians_q32(step.arc->sweep_deg)));
        const std::array<S, 2> legs{product_up_to(norm(arm, 3), angle, literal<S>(0x1p29)), rise};
        return norm(legs, 2);
    }
    return norm(way, 3);
}

template <Scalar S>
S Interpreter<S>::path_feed(const ProgramStep& step) const noexcept {
    bool space = step.shape != MoveShape::line;
    bool others = false;
    for (int axis = 0; axis < letters().count(); ++axis) {
        const auto k = static_cast<unsigned>(axis);
        const bool moves = step.from[k] != step.to[k];
        const bool linear = letters().kind(axis) == AxisKind::linear;
        space = space || (moves && linear);
        others = others || (moves && !linear);
    }
    const MoveManner& how = manner();
    const S per_second = smaller(to_scalar<S>(how.feed, 60), literal<S>(0x1p30));
    if (!how.inverse_time && !others) {
        return clamped(per_second);
    }
    PerAxis<S> second{};
    PerAxis<S> rotary{};
    PerAxis<S> extruder{};
    PerAxis<S> counted_by_plan{}; // but x, y and z
    PerAxis<S> left_by_plan{};
    for (int axis = 0; axis < letters().count(); ++axis) {
        const auto k = static_cast<unsigned>(axis);
        const AxisKind kind = letters().kind(axis);
        if (kind != AxisKind::linear) {
            const S way = length_mm<S>(step.from[k], step.to[k]);
            (kind == AxisKind::second_linear ? second : kind == AxisKind::rotary ? rotary : extruder)[k] = way;
            (plan_counts(axis) ? counted_by_plan : left_by_plan)[k] = way;
        }
    }
    const S in_space = space_length(step);
    const S in_second = norm(second, max_axes);
    const S degrees = norm(rotary, max_axes);
    const bool in_inches = how.feed_in_inches && !rules().degree_is_mm;
    const S in_rotary = in_inches ? product_up_to(degrees, literal<S>(25.4), literal<S>(0x1p29)) : degrees;
    const S in_extruder = norm(extruder, max_axes);
    const std::array<S, 2> parts{in_space, norm(counted_by_plan, max_axes)};
    S total = norm(parts, 2);
    total = total > S{} ? total : norm(left_by_plan, max_axes);
    if (how.inverse_time) {
        // Its part in the linear axes may be tiny; 0 would be the machine's feed.
        return larger(product_up_to(total, per_second, literal<S>(fastest_mm_s)), literal<S>(0x1p-32));
    }
    const std::array<S, 3> all{in_space, in_second, in_rotary};
    const S counted = rules().feed_of_all_axes ? norm(all, 3)
                      : space                  ? in_space
                      : in_second > S{}        ? in_second
                      : in_rotary > S{}        ? in_rotary
                                               : in_extruder;
    const S feed = product_up_to(quotient_or_max(total, counted), clamped(per_second), literal<S>(fastest_mm_s));
    return rules().feed_of_all_axes ? larger(feed, literal<S>(0x1p-32)) : clamped(feed); // as above
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(Interpreter)
#endif

} // namespace splinefeed
