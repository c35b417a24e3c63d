// SPDX-License-Identifier: MIT
// Progress: a line on a terminal that shows the progress of a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::host {

struct ProgressOptions {
    bool quiet = false;
    std::optional<std::uint64_t> all = std::nullopt; ///< number of waypoints or moves, if it is known
    int descriptor = 2;                              ///< standard error
};

/// How far a run is.
struct ProgressNow {
    std::uint64_t done = 0; ///< waypoints or, of a program, moves
    std::uint64_t line = 0; ///< of a program; 0: there are only waypoints
    double motion_s = 0.0;
    bool executed = false;  ///< by a real machine, in real time; false: planned
    std::string place = {}; ///< of a real machine: " x=1.000 y=2.000"
};

/// Shows the waypoints - of a program its line and its moves -, at most ten times a second, and erases the line at the
/// end: what is planned with its rate, or what a machine has executed with the time that is left and its place. Writes
/// nothing if the descriptor is not a terminal. Cost of due(): a look at the clock at every 64th call, nothing else
/// between redraws.
class Progress {
public:
    using Options = ProgressOptions;

    explicit Progress(const Options& options = {});
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { finish(); }

    /// Whether the line is to be drawn: show().
    [[nodiscard]] bool due() noexcept { return shown_ && (calls_++ & 63U) == 0U && Clock::now() >= next_; }
    void show(const ProgressNow& now);
    /// Erases the line; nothing is drawn afterwards.
    void finish() noexcept;

    /// The text of the line, at most 79 characters.
    [[nodiscard]] static std::string text(const ProgressNow& now, std::optional<std::uint64_t> all, double wall_s);

private:
    using Clock = std::chrono::steady_clock;

    std::optional<std::uint64_t> all_;
    int descriptor_;
    bool shown_;
    bool drawn_ = false;
    std::uint64_t calls_ = 0;
    Clock::time_point start_;
    Clock::time_point next_;
};

} // namespace splinefeed::host
