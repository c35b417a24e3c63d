// SPDX-License-Identifier: MIT
#include "host_sim/output/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr std::chrono::milliseconds redraw_period{100};
constexpr std::size_t bar_width = 12;
constexpr std::size_t line_width = 79;

// Progress is a courtesy: what a terminal does not take is dropped.
void show(int descriptor, std::string_view text) noexcept {
    [[maybe_unused]] const ssize_t written = write(descriptor, text.data(), text.size());
}

std::string bar(double fraction) {
    const auto full = static_cast<std::size_t>(fraction * static_cast<double>(bar_width));
    return fmt::format("[{}{}] {:3.0f} %  ", std::string(full, '#'), std::string(bar_width - full, '.'),
                       fraction * 100.0);
}

} // namespace

Progress::Progress(const Options& options)
    : waypoints_(options.waypoints), descriptor_(options.descriptor),
      shown_(!options.quiet && isatty(options.descriptor) == 1), start_(Clock::now()), next_(start_ + redraw_period) {}

std::string Progress::text(std::uint64_t waypoints, std::optional<std::uint64_t> all, double motion_s, double wall_s) {
    std::string line;
    if (all && *all > 0) {
        const double fraction = std::min(static_cast<double>(waypoints) / static_cast<double>(*all), 1.0);
        line = bar(fraction) + fmt::format("{} of {} waypoints", waypoints, *all);
    } else {
        line = fmt::format("{} waypoints", waypoints);
    }
    if (wall_s > 0.0) {
        line += fmt::format(" ({:.0f}/s)", static_cast<double>(waypoints) / wall_s);
    }
    line += fmt::format(", {:.1f} s planned", motion_s);
    if (line.size() > line_width) {
        line.resize(line_width);
    }
    return line;
}

void Progress::redraw(std::uint64_t waypoints, double motion_s) {
    const Clock::time_point now = Clock::now();
    if (now < next_) {
        return;
    }
    next_ = now + redraw_period;
    const double wall_s = std::chrono::duration<double>(now - start_).count();
    show(descriptor_, fmt::format("\r{}\x1b[K", text(waypoints, waypoints_, motion_s, wall_s)));
    drawn_ = true;
}

void Progress::finish() noexcept {
    if (drawn_) {
        show(descriptor_, "\r\x1b[K");
    }
    drawn_ = shown_ = false;
}

} // namespace splinefeed::host
