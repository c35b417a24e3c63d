// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/clock_estimate.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t slot_us = 500'000;
constexpr std::uint64_t least_span_us = 3'000'000; // for a slope
constexpr double most_skew = 1e-3;                 // no crystal is worse

} // namespace

// Both bounds hold, so their intersection does: random delays loosen one end or the other. If the intersection is less
// than half as wide as the tighter bounds, the difference is clock drift: then only the tighter bounds are used.
ClockEstimate::Sample ClockEstimate::common(const Sample& a, const Sample& b) noexcept {
    const Sample& tighter = b.width_us < a.width_us ? b : a;
    const auto half = [](const Sample& sample) {
        return static_cast<std::int64_t>(sample.width_us / 2);
    };
    const std::int64_t low = std::max(a.offset_us - half(a), b.offset_us - half(b));
    const std::int64_t high = std::min(a.offset_us + half(a), b.offset_us + half(b));
    if (high - low < half(tighter)) {
        return tighter;
    }
    return {tighter.host_us, low + (high - low) / 2, static_cast<std::uint64_t>(high - low)};
}

void ClockEstimate::sample(const ExchangeInstants& exchange, std::uint32_t clock_us) noexcept {
    if (exchange.replied_us < exchange.arrived_us && !has_no_rate_) {
        has_no_rate_ = true;
        count_ = 0; // those bounds were too tight, too
    }
    sample(earliest_us(exchange), has_no_rate_ ? exchange.answered_us : exchange.replied_us, clock_us);
}

void ClockEstimate::sample(std::uint64_t earliest_us, std::uint64_t latest_us, std::uint32_t clock_us) noexcept {
    // The drive's clock wraps every 71 minutes; the host clock gives the number of wraps since the last sample.
    const std::int64_t expected_us =
        sampled_us_ == 0 ? 0 : clock_us_ + static_cast<std::int64_t>(earliest_us - sampled_us_);
    clock_us_ = expected_us + static_cast<std::int32_t>(
                                  clock_us - static_cast<std::uint32_t>(static_cast<std::uint64_t>(expected_us)));
    sampled_us_ = earliest_us;
    if (latest_us < earliest_us) {
        return; // not an answer to this request
    }
    const std::uint64_t width = latest_us - earliest_us;
    const std::uint64_t middle = earliest_us + width / 2;
    const Sample taken{middle, clock_us_ - static_cast<std::int64_t>(middle), width};
    const std::uint64_t slot = middle / slot_us;
    if (count_ > 0 && slot == slot_) {
        Sample& last = samples_[(first_ + count_ - 1) % kept];
        last = common(last, taken);
        return;
    }
    slot_ = slot;
    if (count_ == kept) {
        first_ = (first_ + 1) % kept;
        --count_;
    }
    samples_[(first_ + count_) % kept] = taken;
    ++count_;
}

// Least squares, each sample weighted by the inverse square of its width. Over a short span the slope is 0.
ClockEstimate::Line ClockEstimate::line() const noexcept {
    Line line;
    line.origin_us = at(count_ - 1).host_us;
    const auto base = static_cast<double>(at(count_ - 1).offset_us);
    double sum = 0.0;
    double sum_t = 0.0;
    double sum_o = 0.0;
    double sum_tt = 0.0;
    double sum_to = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Sample& sample = at(i);
        const double width = static_cast<double>(sample.width_us) + 1.0;
        const double weight = 1.0 / (width * width);
        const double t = -static_cast<double>(line.origin_us - sample.host_us);
        const auto o = static_cast<double>(sample.offset_us - at(count_ - 1).offset_us);
        sum += weight;
        sum_t += weight * t;
        sum_o += weight * o;
        sum_tt += weight * t * t;
        sum_to += weight * t * o;
    }
    const double spread = sum_tt - sum_t * sum_t / sum;
    if (line.origin_us - at(0).host_us >= least_span_us && spread > 0.0) {
        const double slope = (sum_to - sum_t * sum_o / sum) / spread;
        line.slope = slope > most_skew ? most_skew : slope < -most_skew ? -most_skew : slope;
    }
    line.offset_us = base + (sum_o - line.slope * sum_t) / sum;
    return line;
}

std::int64_t ClockEstimate::drive_us(std::uint64_t host_us) const noexcept {
    const Line through = line();
    const auto since = static_cast<double>(static_cast<std::int64_t>(host_us - through.origin_us));
    const double offset = through.offset_us + through.slope * since;
    return static_cast<std::int64_t>(host_us) + static_cast<std::int64_t>(offset < 0.0 ? offset - 0.5 : offset + 0.5);
}

double ClockEstimate::skew_ppm() const noexcept {
    return count_ > 0 ? 1e6 * line().slope : 0.0;
}

double ClockEstimate::uncertainty_us() const noexcept {
    std::uint64_t least = at(0).width_us;
    for (std::size_t i = 1; i < count_; ++i) {
        least = at(i).width_us < least ? at(i).width_us : least;
    }
    return 0.5 * static_cast<double>(least) + 1.0;
}

} // namespace splinefeed::hal::modbus
