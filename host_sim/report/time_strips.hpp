// SPDX-License-Identifier: MIT
// TimeStrips: quantities over the time of a run in bounded memory: of each short time the smallest and the largest.
#pragma once

#include <cstdint>
#include <vector>

namespace splinefeed::host {

/// Bins of equal time. When there are too many, two become one that is twice as long: so no extreme is ever lost.
/// Memory: most_bins bins. Cost of add(): a comparison a channel.
class TimeStrips {
public:
    static constexpr std::size_t most_bins = 32768; ///< even

    struct Range {
        float low = 0.0F;
        float high = 0.0F;
    };
    /// What a bin has besides its channels.
    struct Bin {
        double length_mm = 0.0; ///< travelled at its begin
        float feed_mm_s = 0.0F; ///< the largest programmed
        std::uint8_t code = 0;  ///< the one that held longest
        double weight = 0.0;    ///< of that code
        bool filled = false;
    };

    /// @param bin_ticks  first duration of a bin, in 1/8 us
    TimeStrips(std::size_t channels, std::uint64_t bin_ticks) : channels_(channels), bin_ticks_(bin_ticks) {}

    /// A part of the run that begins at `ticks`. In order of time. @param values  one for each channel
    void add(std::uint64_t ticks, double seconds, const Range* values, double length_mm, double feed_mm_s,
             std::uint8_t code);

    [[nodiscard]] std::size_t channels() const noexcept { return channels_; }
    [[nodiscard]] std::uint64_t bin_ticks() const noexcept { return bin_ticks_; }
    [[nodiscard]] const std::vector<Bin>& bins() const noexcept { return bins_; }
    [[nodiscard]] const Range& range(std::size_t bin, std::size_t channel) const noexcept {
        return ranges_[bin * channels_ + channel];
    }

private:
    void halve();
    void merge(std::size_t into, std::size_t from);
    void open(std::size_t bin, double length_mm);

    std::size_t channels_;
    std::uint64_t bin_ticks_;
    std::vector<Bin> bins_;
    std::vector<Range> ranges_;
};

} // namespace splinefeed::host
