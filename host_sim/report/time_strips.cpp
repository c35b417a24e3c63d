// SPDX-License-Identifier: MIT
#include "host_sim/report/time_strips.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

// Of two codes the one that holds longer; the difference of their times remains (the vote of Boyer and Moore).
void vote(TimeStrips::Bin& bin, std::uint8_t code, double weight) {
    if (code == bin.code) {
        bin.weight += weight;
    } else if ((bin.weight -= weight) < 0.0) {
        bin.code = code;
        bin.weight = -bin.weight;
    }
}

void widen(TimeStrips::Range& range, const TimeStrips::Range& by) {
    range.low = std::min(range.low, by.low);
    range.high = std::max(range.high, by.high);
}

} // namespace

void TimeStrips::add(std::uint64_t ticks, double seconds, const Range* values, double length_mm, double feed_mm_s,
                     std::uint8_t code) {
    while (ticks / bin_ticks_ >= most_bins) {
        halve();
    }
    const std::size_t index = ticks / bin_ticks_;
    open(index, length_mm);
    Bin& bin = bins_[index];
    for (std::size_t c = 0; c < channels_; ++c) {
        Range& range = ranges_[index * channels_ + c];
        if (bin.filled) {
            widen(range, values[c]);
        } else {
            range = values[c];
        }
    }
    bin.filled = true;
    bin.feed_mm_s = std::max(bin.feed_mm_s, static_cast<float>(feed_mm_s));
    vote(bin, code, seconds);
}

// Bins between two parts, where a part is longer than a bin, are as the one before them.
void TimeStrips::open(std::size_t bin, double length_mm) {
    while (bins_.size() <= bin) {
        const std::size_t before = ranges_.size() - (bins_.empty() ? 0 : channels_);
        bins_.push_back(bins_.empty() ? Bin{} : bins_.back());
        for (std::size_t c = 0; c < channels_; ++c) {
            ranges_.push_back(bins_.size() > 1 ? ranges_[before + c] : Range{});
        }
        if (bins_.size() > bin) {
            bins_.back() = {.length_mm = length_mm};
        }
    }
}

void TimeStrips::merge(std::size_t into, std::size_t from) {
    const Bin& other = bins_[from];
    bins_[into].feed_mm_s = std::max(bins_[into].feed_mm_s, other.feed_mm_s);
    vote(bins_[into], other.code, other.weight);
    for (std::size_t c = 0; c < channels_; ++c) {
        widen(ranges_[into * channels_ + c], ranges_[from * channels_ + c]);
    }
}

void TimeStrips::halve() {
    for (std::size_t i = 0; i < bins_.size(); i += 2) {
        if (i + 1 < bins_.size()) {
            merge(i, i + 1);
        }
        bins_[i / 2] = bins_[i];
        std::copy_n(ranges_.begin() + static_cast<std::ptrdiff_t>(i * channels_), channels_,
                    ranges_.begin() + static_cast<std::ptrdiff_t>(i / 2 * channels_));
    }
    bins_.resize((bins_.size() + 1) / 2);
    ranges_.resize(bins_.size() * channels_);
    bin_ticks_ *= 2;
}

} // namespace splinefeed::host
