// SPDX-License-Identifier: MIT
//
// A general conversion of a double to decimals must be right for any double and costs accordingly. Here the integer
// part and the fraction are integers of at most 16 digits: splitting them is exact, scaling the fraction rounds once,
// to 2^-53 of itself. The last decimal is therefore the nearest one, but for ties to within 1e-4 of its value.
#include "host_sim/output/trace_writer.hpp"

#include "splinefeed/base/units.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace splinefeed::host {

namespace {

constexpr double largest_fast = 1e15; // whole part below 2^50

// A separator, a sign, 16 digits, a point and 12 decimals; 1e308 with 12 decimals needs 323.
constexpr std::size_t longest_number = 336;

char* write_digits(char* out, std::uint64_t value, int digits) {
    for (int i = digits - 1; i >= 0; --i) {
        out[i] = static_cast<char>('0' + value % 10U);
        value /= 10U;
    }
    return out + digits;
}

char* write_whole(char* out, std::uint64_t value) {
    int digits = 1;
    for (std::uint64_t rest = value; rest >= 10U; rest /= 10U) {
        ++digits;
    }
    return write_digits(out, value, digits);
}

// Writes value with Decimals decimals, "-0.000" as "0.000".
template <int Decimals>
char* write_fixed(char* out, double value) {
    constexpr auto scale = [] {
        std::uint64_t power = 1;
        for (int i = 0; i < Decimals; ++i) {
            power *= 10U;
        }
        return power;
    }();
    const double size = std::fabs(value);
    if (!(size < largest_fast)) { // huge, infinite, not a number
        return fmt::format_to(out, "{:.{}f}", value, Decimals);
    }
    auto whole = static_cast<std::uint64_t>(size);
    const double fraction = (size - static_cast<double>(whole)) * static_cast<double>(scale);
    auto decimals = static_cast<std::uint64_t>(std::llround(fraction));
    if (decimals >= scale) {
        decimals -= scale;
        ++whole;
    }
    if (value < 0.0 && (whole | decimals) != 0U) {
        *out++ = '-';
    }
    out = write_whole(out, whole);
    *out++ = '.';
    return write_digits(out, decimals, Decimals);
}

// In integers: a double would not know whole microseconds after two years.
char* write_time(char* out, std::uint64_t ticks) {
    constexpr std::uint64_t ns_per_tick = 1000 / ticks_per_us;
    const std::uint64_t us = ticks / ticks_per_us;
    const std::uint64_t rest = ticks % ticks_per_us;
    out = write_whole(out, us / us_per_s);
    *out++ = '.';
    out = write_digits(out, us % us_per_s, 6);
    return rest == 0 ? out : write_digits(out, rest * ns_per_tick, 3);
}

} // namespace

TraceWriter::TraceWriter(OutputFile& file, const MachineDescription& machine, bool has_lines)
    : file_(&file), axes_(static_cast<unsigned>(machine.settings.axes)), has_lines_(has_lines) {
    file.append("t");
    for (unsigned k = 0; k < axes_; ++k) {
        file.format(",{}", machine.axis_name[k]);
    }
    file.append(has_lines ? ",speed,line\n" : ",speed\n");
}

void TraceWriter::row(std::uint64_t ticks, const PerAxis<double>& position_mm, double speed_mm_s) {
    std::array<char, (max_axes + 3) * longest_number> line; // NOLINT: written before it is read
    char* out = write_time(line.data(), ticks);
    for (unsigned k = 0; k < axes_; ++k) {
        *out++ = ',';
        out = write_fixed<12>(out, position_mm[k]);
    }
    *out++ = ',';
    out = write_fixed<9>(out, speed_mm_s);
    if (has_lines_) {
        *out++ = ',';
        out = write_whole(out, line_);
    }
    *out++ = '\n';
    file_->append({line.data(), static_cast<std::size_t>(out - line.data())});
}

} // namespace splinefeed::host
