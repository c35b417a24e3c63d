// SPDX-License-Identifier: MIT
// FlowBlock: lines that are executed from memory, and where their O words lead.
#pragma once

#include "host_sim/program/gcode/flow_word.hpp"
#include "host_sim/program/source_line.hpp"

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

/// A subprogram, a condition or a loop, from its first word to its last one. Each word of it knows the others that it
/// belongs to, so that a jump costs the same however long the block is. Lines are counted from 0.
class FlowBlock {
public:
    static constexpr std::size_t deepest = 1000; ///< structures within one another

    /// An O word and its structure.
    struct Place {
        FlowWord word;
        std::size_t begin = 0; ///< first line of the structure; of break and continue: of the loop that they name
        std::size_t end = 0;   ///< its last line, but not of break and continue
        std::size_t next = 0;  ///< of if and elseif: the next elseif, else or endif
        bool wrong = false;    ///< it belongs to nothing, or its structure has no end
    };

    /// A line with a number N, which GOTO may name.
    struct Label {
        std::size_t line = 0;
        std::size_t around = 0; ///< first line of the innermost structure that it is in; no_line: none
        std::size_t count = 0;  ///< lines with this number
    };
    static constexpr std::size_t no_line = std::numeric_limits<std::size_t>::max();

    /// What is wrong with the order of the words.
    struct Problem {
        std::size_t line = 0;
        std::size_t at = 0; ///< offset in the line
        std::string text;
    };
    static constexpr std::size_t most_problems = 1000;

    explicit FlowBlock(std::uint64_t number) noexcept : number_(number) {}

    void add(SourceLine line);
    void add(SourceLine line, FlowWord word);
    /// Finds where the words lead, after the last line. Empty: they fit. Otherwise the words that do not are `wrong`;
    /// without them, and with the label of its begin for an end that names another, what remains fits.
    [[nodiscard]] std::vector<Problem> link();

    /// Tells blocks apart, those that are gone, too.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
    [[nodiscard]] const SourceLine& line(std::size_t at) const { return lines_[at]; }
    /// Null: the line has no O word.
    [[nodiscard]] const Place* place(std::size_t at) const {
        return place_of_[at] > 0 ? &places_[place_of_[at] - 1] : nullptr;
    }
    /// Null: no line has the number. Finds all of them when first asked. @pre link() has found nothing wrong
    [[nodiscard]] const Label* label(std::uint32_t number) const;
    /// Whether a jump from one line leads to the other without entering a structure.
    [[nodiscard]] bool leads(std::size_t from, const Label& to) const {
        return to.around == no_line || (from >= to.around && from <= places_[place_of_[to.around] - 1].end);
    }
    /// A part of it, from a word to the end of its structure. @pre link() has found nothing wrong
    [[nodiscard]] FlowBlock part(std::size_t from, std::uint64_t number) const;

private:
    [[nodiscard]] Place& known(std::size_t line) { return places_[place_of_[line] - 1]; }
    void link_word(std::size_t line);
    void enter(std::size_t line);
    void enter_loop(std::size_t line);
    bool require_no_o_word(std::size_t line);
    /// A word that ends or divides a structure.
    void end_or_branch(std::size_t line);
    void branch(std::size_t line);
    void close(std::size_t line);
    void leave(std::size_t line);
    /// Whether the structure of the line has its end behind another line.
    [[nodiscard]] bool ends_behind(std::size_t begin, std::size_t line) const;
    [[nodiscard]] std::size_t open_place(FlowKind begin, const std::string& label) const;
    /// The structure of the line is none.
    void give_up(std::size_t begin, std::size_t last_line);
    void add_problem(std::size_t line, std::size_t at, std::string text);
    void add_stray(std::size_t line);
    void find_labels() const;

    std::uint64_t number_;
    std::vector<SourceLine> lines_;
    std::vector<std::uint32_t> place_of_; // of each line, from 1; 0: none
    std::vector<Place> places_;
    std::vector<std::size_t> open_; // first lines of the structures around a line, while it is linked
    std::vector<Problem> problems_;
    mutable std::map<std::uint32_t, Label> labels_;
    mutable bool has_labels_ = false;
};

} // namespace splinefeed::host
