// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_record.hpp"

#include <array>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::size_t longest_number = 24;

char* write_digits(char* out, std::uint64_t value, int least) {
    std::array<char, longest_number> reversed{};
    int count = 0;
    for (; value != 0 || count < least; value /= 10U) {
        reversed[static_cast<std::size_t>(count++)] = static_cast<char>('0' + value % 10U);
    }
    while (count > 0) {
        *out++ = reversed[static_cast<std::size_t>(--count)];
    }
    return out;
}

// A number of thousandths, or of millionths, with its point.
template <int Decimals>
char* write_scaled(char* out, std::int64_t value) {
    constexpr std::uint64_t scale = Decimals == 3 ? 1000 : 1000000;
    if (value < 0) {
        *out++ = '-';
    }
    const auto size = static_cast<std::uint64_t>(value < 0 ? -value : value);
    out = write_digits(out, size / scale, 1);
    *out++ = '.';
    return write_digits(out, size % scale, Decimals);
}

} // namespace

DriveRecord::DriveRecord(const std::string& path, std::string_view profile, int axes, double start_s) : file_(path) {
    file_.format("# splinefeed drive, profile {}; shafts in counts, t in s of the drive's own time\n", profile);
    file_.format("# t = 0 is CLOCK_MONOTONIC {:.6f} s\n", start_s);
    file_.append("t");
    for (int k = 0; k < axes; ++k) {
        file_.format(",a{}", k);
    }
    file_.append("\n");
}

void DriveRecord::row(std::uint64_t time_ms, const DriveModel& drive) {
    std::array<char, (max_axes + 1) * longest_number> line; // NOLINT: written before it is read
    char* out = write_scaled<3>(line.data(), static_cast<std::int64_t>(time_ms));
    for (int k = 0; k < drive.axes(); ++k) {
        *out++ = ',';
        out = write_scaled<6>(out, std::llround(drive.position_counts(k) * 1e6));
    }
    *out++ = '\n';
    file_.append({line.data(), static_cast<std::size_t>(out - line.data())});
}

SegmentRecord::SegmentRecord(const std::string& path, int axes) : file_(path), axes_(static_cast<unsigned>(axes)) {
    file_.append("# positions in 1/65536 count, velocities in 1/16777216 count per duration, 8000000 ticks a second\n");
    file_.append("sequence,duration_ticks");
    for (unsigned k = 0; k < axes_; ++k) {
        file_.format(",a{0}_end,a{0}_v_end", k);
    }
    file_.append(",t_end\n");
}

void SegmentRecord::row(const ExecutedSegment& executed) {
    file_.format("{},{}", executed.sequence, executed.segment.duration_ticks);
    for (unsigned k = 0; k < axes_; ++k) {
        file_.format(",{},{}", executed.segment.end[k], executed.segment.end_velocity[k]);
    }
    file_.format(",{:.9f}\n", executed.end_us * 1e-6);
}

} // namespace splinefeed::host
