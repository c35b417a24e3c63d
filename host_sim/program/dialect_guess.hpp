// SPDX-License-Identifier: MIT
// DialectGuess: whose words a program has, by its first lines.
#pragma once

#include "host_sim/program/line_readings.hpp"

#include "splinefeed/s0_program/dialects/program_settings.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Evidence is a comment that names the controller, or what only one controller has. The dialect with most of it is
/// taken, and linuxcnc where there is too little.
class DialectGuess {
public:
    static constexpr std::uint64_t most_lines = 200;
    static constexpr std::size_t dialects = 5;
    static constexpr int enough =
        5; ///< points of evidence: one usual sign; a word that no other dialect has counts more
    static constexpr int named = 20; ///< those of a comment that names the controller

    void add(std::string_view line, std::uint64_t number);
    [[nodiscard]] Dialect dialect() const noexcept;
    /// The strongest evidence: "'M104 S200' on line 12". Empty: there is none.
    [[nodiscard]] std::string reason() const;
    /// Lines that dialects with some evidence read otherwise than `taken`, and how; where no more than a word says
    /// whose the program is, those of all controllers of mills. Empty: there are none, or a comment names the
    /// controller.
    [[nodiscard]] std::string differences(Dialect taken) const;

private:
    struct Evidence {
        int points = 0; // of all of it
        int best = 0;
        std::uint64_t line = 0; // of the best
        std::string text;
    };

    enum class Motion : std::uint8_t { none, stated, ended }; // by G80

    void count(Dialect dialect, int points, std::string_view text, std::uint64_t line);
    void count_if_free(Dialect dialect, std::string_view text, std::uint64_t line);
    void read_comment(std::string_view comment, std::uint64_t line);
    void read_words(std::string_view code, std::string_view macro, std::uint64_t line);
    void read_motion(std::string_view code, std::string_view plain, std::uint64_t line);

    std::array<Evidence, dialects> evidence_{};
    LineReadings readings_;
    bool percent_ = false;
    Motion motion_ = Motion::none;
};

} // namespace splinefeed::host
