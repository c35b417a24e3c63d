// SPDX-License-Identifier: MIT
#include "host_sim/output/progress.hpp"

#include "host_sim/base/standard_streams.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr std::chrono::milliseconds redraw_period{100};
constexpr std::size_t bar_width = 12;
constexpr std::size_t line_width = 79;

std::string bar(double fraction) {
    const auto full = static_cast<std::size_t>(fraction * static_cast<double>(bar_width));
    return fmt::format("[{}{}] {:3.0f} %  ", std::string(full, '#'), std::string(bar_width - full, '.'),
                       fraction * 100.0);
}

} // namespace

Progress::Progress(const Options& options)
    : all_(options.all), descriptor_(options.descriptor), shown_(!options.quiet && isatty(options.descriptor) == 1),
      start_(Clock::now()), next_(start_ + redraw_period) {}

std::string Progress::text(const ProgressNow& now, std::optional<std::uint64_t> all, double wall_s) {
    const bool known = all && *all > 0;
    std::string text;
    if (known) {
        text = bar(std::min(static_cast<double>(now.done) / static_cast<double>(*all), 1.0));
    }
    const std::string count = known ? fmt::format("{} of {}", now.done, *all) : fmt::format("{}", now.done);
    text += now.line > 0 ? fmt::format("line {}, move {}", now.line, count) : fmt::format("{} waypoints", count);
    if (!now.executed) {
        text += wall_s > 0.0 ? fmt::format(" ({:.0f}/s)", static_cast<double>(now.done) / wall_s) : "";
        text += fmt::format(", {:.1f} s planned", now.motion_s);
    } else {
        text += fmt::format(", {:.1f} s", now.motion_s);
        if (known && now.done > 0) { // as if all took the same time
            const auto done = static_cast<double>(std::min(now.done, *all));
            text += fmt::format(", {:.0f} s left", now.motion_s * (static_cast<double>(*all) - done) / done);
        }
        text += now.place;
    }
    if (text.size() > line_width) {
        text.resize(line_width);
    }
    return text;
}

void Progress::show(const ProgressNow& now) {
    const Clock::time_point time = Clock::now();
    next_ = time + redraw_period;
    draw_line(descriptor_, text(now, all_, std::chrono::duration<double>(time - start_).count()));
    drawn_ = true;
}

void Progress::finish() noexcept {
    if (drawn_) {
        draw_line(descriptor_, {});
    }
    drawn_ = shown_ = false;
}

} // namespace splinefeed::host
