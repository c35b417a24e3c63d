// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/thread_cycle.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr std::int32_t most_passes = 100000;
constexpr Decimal steepest = Decimal::from_integer(80);

} // namespace

BlockStatus ThreadCycle::read_words(const Block& block, const ModalState& modal) noexcept {
    const auto radius = [&](char letter) {
        const Decimal value = modal.in_mm(block.value(letter));
        return modal.diameter ? Decimal{value.raw / 2} : value;
    };
    const auto positive = [&](char letter) {
        return modal.in_mm(block.value(letter)).raw > 0 ? modal.in_mm(block.value(letter)) : Decimal{};
    };
    inside_ = radius('i').raw > 0;
    peak_.raw = static_cast<std::int64_t>(detail::magnitude(radius('i').raw));
    cut_ = radius('j');
    height_ = radius('k');
    end_depth_ = peak_ + height_;
    pitch_ = positive('p');
    taper_ = positive('e');
    const Decimal degression = block.value('r') > Decimal{Decimal::one} ? block.value('r') : Decimal{Decimal::one};
    exponent_.raw = product_quotient(Decimal::one, Decimal::one, static_cast<std::uint64_t>(degression.raw)).raw;
    compound_ = sine_cosine(block.value('q'));
    tapers_ = springs_ = 0;
    const bool whole = (!block.has('l') || to_integer(block.value('l'), tapers_)) &&
                       (!block.has('h') || to_integer(block.value('h'), springs_));
    if (!whole || peak_.raw == 0 || cut_.raw <= 0 || height_ <= cut_ || pitch_.raw == 0 || tapers_ < 0 || tapers_ > 3 ||
        springs_ < 0 || springs_ > most_passes || block.value('q').raw < 0 || block.value('q') > steepest) {
        return block.at(ProgramError::thread_word_invalid, CodeGroup::motion);
    }
    const Decimal ratio{product_quotient(height_.raw, Decimal::one, static_cast<std::uint64_t>(cut_.raw)).raw};
    const ProgramResult<Decimal> passes = power(ratio, degression);
    if (!passes.has_value() || *passes > Decimal::from_integer(most_passes)) {
        return block.at(ProgramError::thread_word_invalid, 'j');
    }
    return {};
}

BlockStatus ThreadCycle::begin(const Block& block, const ModalState& modal, Decimal x, Decimal z,
                               Decimal end_z) noexcept {
    if (const BlockStatus status = read_words(block, modal); !status.ok()) {
        return status;
    }
    x_ = x;
    start_z_ = z;
    const Decimal way = end_z - z;
    const auto room = static_cast<std::int64_t>(detail::magnitude(way.raw)) / (tapers_ == 3 ? 2 : 1);
    if (way.raw == 0 || (tapers_ > 0 && taper_.raw > room)) {
        return block.at(ProgramError::thread_word_invalid, way.raw == 0 ? 'z' : 'e');
    }
    taper_pitch_ = pitch_;
    if (taper_.raw > 0) {
        taper_pitch_.raw =
            product_quotient(pitch_.raw, hypotenuse(taper_, height_).raw, static_cast<std::uint64_t>(taper_.raw)).raw;
    }
    if (way.raw > 0) {
        taper_ = -taper_;
        compound_.sine = -compound_.sine;
    }
    depth_ = peak_ + cut_;
    pass_ = 1;
    phase_ = Phase::back;
    target_z_ = end_z + shift(end_depth_);
    return {};
}

// How far a pass of this depth begins before the start along Z: the tool goes in at an angle.
Decimal ThreadCycle::shift(Decimal depth) const noexcept {
    return {product_quotient((depth - peak_).raw, compound_.sine, static_cast<std::uint64_t>(compound_.cosine)).raw};
}

void ThreadCycle::go_deeper() noexcept {
    if (depth_ >= end_depth_) {
        --springs_;
        return;
    }
    const ProgramResult<Decimal> times = power(Decimal::from_integer(++pass_), exponent_);
    depth_ = end_depth_;
    if (times.has_value()) {
        const Decimal deeper =
            peak_ + Decimal{product_quotient(cut_.raw, times->raw, static_cast<std::uint64_t>(Decimal::one)).raw};
        depth_ = deeper < end_depth_ ? deeper : end_depth_;
    }
}

bool ThreadCycle::next(Move& out) noexcept {
    if (springs_ < 0) {
        return false;
    }
    const bool tapered_in = (tapers_ & 1) != 0 && taper_.raw != 0;
    const bool tapered_out = (tapers_ & 2) != 0 && taper_.raw != 0;
    const Decimal start = start_z_ - shift(depth_);
    const Decimal end = target_z_ - shift(depth_);
    const Decimal outside = at_depth(depth_ - end_depth_);
    const Decimal before = at_depth(depth_ - height_);
    const Decimal inside = at_depth(depth_);
    switch (phase_) {
    case Phase::back:
        out = {false, false, outside, start, {}};
        phase_ = Phase::in;
        break;
    case Phase::in:
        out = tapered_in ? Move{true, true, before, start, taper_pitch_} : Move{false, false, inside, start, {}};
        phase_ = tapered_in ? Phase::angled_in : Phase::over;
        break;
    case Phase::angled_in:
        out = {true, false, inside, start - taper_, taper_pitch_};
        phase_ = Phase::over;
        break;
    case Phase::over:
        out = {true, !tapered_in, inside, tapered_out ? end + taper_ : end, pitch_};
        phase_ = tapered_out ? Phase::angled_out : Phase::out;
        break;
    case Phase::angled_out:
        out = {true, false, before, end, taper_pitch_};
        phase_ = Phase::out;
        break;
    case Phase::out:
        out = {false, false, outside, end, {}};
        phase_ = Phase::back;
        go_deeper();
        break;
    }
    return true;
}

} // namespace splinefeed
