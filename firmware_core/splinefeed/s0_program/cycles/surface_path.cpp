// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/surface_path.hpp"

#include <algorithm>

namespace splinefeed {

namespace {

Decimal share_of(Decimal value, std::uint32_t part, std::uint64_t whole) noexcept {
    return {product_quotient(value.raw, part, whole).raw};
}

} // namespace

void SurfacePath::begin(const ProgramStep& move, const MoveManner& manner, const WorkFrame& frame, unsigned x,
                        const std::array<unsigned, 3>& plane, const std::array<int, 3>& space) noexcept {
    move_ = move;
    manner_ = manner;
    feed_ = manner.feed;
    mode_ = manner.mode;
    from_ = frame.to_program(move.from);
    to_ = frame.to_program(move.to);
    x_ = static_cast<std::uint8_t>(x);
    for (unsigned k = 0; k < 3; ++k) {
        space_[k] = static_cast<std::int8_t>(space[k]);
    }
    if (move.shape == MoveShape::arc) {
        arc_ = *move.arc;
        sweep_deg_ = arc_.sweep_deg;
        plane_ = {static_cast<std::uint8_t>(plane[0]), static_cast<std::uint8_t>(plane[1])};
        AxisPoint centre = move.from;
        for (unsigned k = 0; k < 3; ++k) {
            if (space_[k] >= 0) {
                centre[static_cast<unsigned>(space_[k])] = arc_.centre[k];
            }
        }
        centre = frame.to_program(centre);
        centre_ = {centre[plane_[0]], centre[plane_[1]]};
        first_radius_ = hypotenuse(from_[plane_[0]] - centre_.first, from_[plane_[1]] - centre_.second);
        last_radius_ = hypotenuse(to_[plane_[0]] - centre_.first, to_[plane_[1]] - centre_.second);
    }
    at_ = 0;
    choose();
}

// A point of the move, in the program's coordinates.
AxisPoint SurfacePath::place(std::uint32_t at) const noexcept {
    AxisPoint out = from_;
    for (unsigned k = 0; k < out.size(); ++k) {
        out[k] += share_of(to_[k] - from_[k], at, whole);
    }
    if (move_.shape == MoveShape::arc) {
        const Decimal a = from_[plane_[0]] - centre_.first;
        const Decimal b = from_[plane_[1]] - centre_.second;
        const SineCosine turn = sine_cosine(share_of(sweep_deg_, at, whole));
        const Decimal radius = first_radius_ + share_of(last_radius_ - first_radius_, at, whole);
        const auto size = static_cast<std::uint64_t>(std::max(first_radius_.raw, std::int64_t{1}));
        const auto scaled = [&](Decimal value) {
            return Decimal{product_quotient(value.raw, radius.raw, size).raw};
        };
        out[plane_[0]] = centre_.first + scaled(turned(a, turn.cosine) - turned(b, turn.sine));
        out[plane_[1]] = centre_.second + scaled(turned(a, turn.sine) + turned(b, turn.cosine));
    }
    return out;
}

Decimal SurfacePath::speed_at(std::uint32_t at) const noexcept {
    return manner_.surface.at(place(at)[x_]);
}

// How far the next piece goes: halves of halves, so that the ends of pieces are those of a row of equal parts.
void SurfacePath::choose() noexcept {
    const Decimal first = speed_at(at_);
    std::uint32_t size = at_ == 0 ? whole : at_ & (~at_ + 1U);
    for (;; size /= 2) {
        const Decimal middle = speed_at(at_ + size / 2);
        const Decimal last = speed_at(at_ + size);
        speed_ = std::min({first, middle, last});
        const Decimal most = std::max({first, middle, last});
        if (size == 2 || (most - speed_).raw <= speed_.raw / 20) {
            break;
        }
    }
    end_ = at_ + size;
}

void SurfacePath::next(const WorkFrame& frame, ProgramStep& out) noexcept {
    const bool is_first = at_ == 0;
    const bool is_last = end_ == whole;
    out = move_;
    out.to = is_last ? move_.to : frame.to_machine(place(end_));
    out.joined = !is_first;
    manner_.mode = !is_last && mode_ == PathMode::exact_stop ? PathMode::exact_path : mode_;
    out.stops_before = move_.stops_before && is_first;
    out.stop_at_end = move_.stop_at_end && is_last;
    if (move_.shape == MoveShape::arc) { // its centre is on the level of its start
        AxisPoint centre = frame.to_program(move_.from);
        centre[plane_[0]] = centre_.first;
        centre[plane_[1]] = centre_.second;
        centre = frame.to_machine(centre);
        for (unsigned k = 0; k < 3; ++k) {
            arc_.centre[k] = space_[k] >= 0 ? centre[static_cast<unsigned>(space_[k])] : Decimal{};
        }
        arc_.sweep_deg = share_of(sweep_deg_, end_, whole) - share_of(sweep_deg_, at_, whole);
        out.arc = &arc_;
    }
    if (manner_.per_turn) {
        manner_.feed.raw = product_quotient(feed_.raw, speed_.raw, static_cast<std::uint64_t>(Decimal::one)).raw;
    } else if (manner_.inverse_time) { // a part of the time
        manner_.feed.raw = product_quotient(feed_.raw, whole, std::uint64_t{end_} - at_).raw;
    }
    move_.from = out.to;
    at_ = end_;
    if (gives()) {
        choose();
    }
}

} // namespace splinefeed
