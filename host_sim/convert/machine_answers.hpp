// SPDX-License-Identifier: MIT
// MachineAnswers: what another controller's file does not say, from the user: at a terminal, or from a file.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

struct MachineQuestion {
    std::string key;     ///< in a file of answers: "x.travel_mm"
    std::string text;    ///< "From where to where does x move, in mm, like 0 300?"
    std::string without; ///< what is so if nobody answers: "no limit"
};

/// Who is asked.
enum class AnswerSource : std::uint8_t { nobody, terminal, file };

class MachineAnswers {
public:
    /// Why the text is no answer; empty: it is one, and was taken.
    using Take = std::function<std::string(std::string_view text)>;

    /// Of nobody, or of the terminal: standard input and standard error.
    /// @param file  that does not say it, for messages
    MachineAnswers(AnswerSource source, std::string file) : source_(source), file_(std::move(file)) {}
    /// Of a file of answers: TOML. Throws InputError.
    MachineAnswers(std::string file, const std::string& answers);

    /// Asks. The answer is taken until it is right; an empty one, or none, leaves it as `without` says. Throws
    /// InputError for a wrong answer of a file.
    void ask(const MachineQuestion& question, const Take& take);
    /// What nobody has answered, a sentence each.
    [[nodiscard]] const std::vector<std::string>& missing() const noexcept { return missing_; }
    /// Throws InputError if the file of answers has some that nobody asked for.
    void close() const;

private:
    struct Given {
        std::string text; ///< numbers with blanks between them, or a word
        std::uint64_t line = 0;
    };
    void ask_terminal(const MachineQuestion& question, const Take& take);
    void add_missing(const MachineQuestion& question);

    AnswerSource source_;
    std::string file_;
    std::string answers_{};
    std::map<std::string, Given> given_{};
    std::vector<std::string> asked_{};
    std::vector<std::string> missing_{};
};

} // namespace splinefeed::host
