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
    : all_(options.all), descriptor_(options.descriptor), shown_(!options.quiet && isatty(options.descriptor) == 1),
      start_(Clock::now()), next_(start_ + redraw_period) {}

std::string Progress::text(std::uint64_t done, std::optional<std::uint64_t> all, std::uint64_t line, double motion_s,
                           double wall_s) {
    const bool known = all && *all > 0;
    std::string text;
    if (known) {
        text = bar(std::min(static_cast<double>(done) / static_cast<double>(*all), 1.0));
    }
    const std::string count = known ? fmt::format("{} of {}", done, *all) : fmt::format("{}", done);
    text += line > 0 ? fmt::format("line {}, move {}", line, count) : fmt::format("{} waypoints", count);
    if (wall_s > 0.0) {
        text += fmt::format(" ({:.0f}/s)", static_cast<double>(done) / wall_s);
    }
    text += fmt::format(", {:.1f} s planned", motion_s);
    if (text.size() > line_width) {
        text.resize(line_width);
    }
    return text;
}

void Progress::redraw(std::uint64_t done, std::uint64_t line, double motion_s) {
    const Clock::time_point now = Clock::now();
    if (now < next_) {
        return;
    }
    next_ = now + redraw_period;
    const double wall_s = std::chrono::duration<double>(now - start_).count();
    show(descriptor_, fmt::format("\r{}\x1b[K", text(done, all_, line, motion_s, wall_s)));
    drawn_ = true;
}

void Progress::finish() noexcept {
    if (drawn_) {
        show(descriptor_, "\r\x1b[K");
    }
    drawn_ = shown_ = false;
}

} // namespace splinefeed::host
