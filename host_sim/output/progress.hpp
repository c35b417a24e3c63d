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

/// Shows the waypoints read - of a program its line and its moves -, their rate and the seconds of motion planned, at
/// most ten times a second, and erases the line at the end. Writes nothing if the descriptor is not a terminal. Cost of
/// update(): a look at the clock at every 64th call, nothing else between redraws.
class Progress {
public:
    using Options = ProgressOptions;

    explicit Progress(const Options& options = {});
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { finish(); }

    /// @param line  of a program, where the motion is, and `done` are the moves up to there; 0: `done` are waypoints
    void update(std::uint64_t done, std::uint64_t line, double motion_s) {
        if (shown_ && (calls_++ & 63U) == 0U) {
            redraw(done, line, motion_s);
        }
    }
    /// Erases the line; nothing is drawn afterwards.
    void finish() noexcept;

    /// The text of the line, at most 79 characters.
    [[nodiscard]] static std::string text(std::uint64_t done, std::optional<std::uint64_t> all, std::uint64_t line,
                                          double motion_s, double wall_s);

private:
    using Clock = std::chrono::steady_clock;

    void redraw(std::uint64_t done, std::uint64_t line, double motion_s);

    std::optional<std::uint64_t> all_;
    int descriptor_;
    bool shown_;
    bool drawn_ = false;
    std::uint64_t calls_ = 0;
    Clock::time_point start_;
    Clock::time_point next_;
};

} // namespace splinefeed::host
