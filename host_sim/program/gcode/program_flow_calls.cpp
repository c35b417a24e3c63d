// SPDX-License-Identifier: MIT
// How ProgramFlow calls subprograms, and finds those that stand behind their call.
#include "host_sim/program/gcode/program_flow.hpp"

#include <algorithm>

namespace splinefeed::host {

void ProgramFlow::execute_call(const FlowWord& word, const SourceLine& line) {
    const std::string label = label_of(word, line);
    const auto sub = find_sub(label);
    if (sub == nullptr && (lost_.contains(label) || wait_for_input(word, line))) {
        return;
    }
    if (sub == nullptr) {
        fail(line, word.label_at, "there is no subprogram o{} in this program; {}", label,
             files_.searched(file_names(label)));
    }
    if (frames_.size() >= deepest) {
        fail(line, word.label_at, "calls are nested more than {} deep", deepest);
    }
    std::vector<Decimal> arguments;
    std::size_t at = word.rest;
    while (at < line.text.size() && line.text[at] == '[') {
        if (arguments.size() == most_arguments) {
            fail(line, at, "a call has at most {} arguments", most_arguments);
        }
        arguments.push_back(value(line.text, at, line));
    }
    require_end(line, at);
    parameters_->enter(arguments);
    frames_.push_back({.code = sub, .at = 1, .call = Call::sub});
}

void ProgramFlow::leave_sub(const FlowWord& word, const SourceLine& line) {
    std::size_t at = word.rest;
    const bool has_value = at < line.text.size() && line.text[at] == '[';
    const Decimal result = has_value ? value(line.text, at, line) : Decimal{};
    require_end(line, at);
    leave_to(Call::sub, word, line, "return stands in a subprogram");
    leave_frame();
    parameters_->write("_value", result);
    parameters_->write("_value_returned", Decimal::from_integer(has_value ? 1 : 0));
}

// The block of the innermost call goes on: what it was within is left.
void ProgramFlow::leave_to(Call call, const FlowWord& word, const SourceLine& line, std::string_view text) {
    const auto called =
        std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& frame) { return frame.call != Call::none; });
    const bool fits =
        called != frames_.rend() && (called->call == call || (call == Call::program && called->call == Call::macro));
    if (!fits) {
        fail(line, word.label_at, text);
    }
    while (frames_.back().call == Call::none) {
        leave_frame();
    }
}

// M98: the number of the program, and how often. #1 to #30 stay those of the caller.
void ProgramFlow::execute_program_call(const FlowWord& word, const SourceLine& line) {
    if (!word.has_number) {
        fail(line, word.label_at, "M98 needs P, the number of the subprogram: M98 P1000, and L for how often");
    }
    if (!word.others.empty() && rules_.programs == NumberedPrograms::linuxcnc) {
        fail(line, word.label_at, "M98 stands alone in its line, with P and L");
    }
    std::string number = label_of(word, line);
    std::size_t at = word.rest;
    std::int64_t times = at > 0 ? value(line.text, at, line).raw / Decimal::one : 1;
    auto code = find_sub(program_label(number));
    if (code == nullptr && !lost_.contains(program_label(number)) && wait_for_input(word, line)) {
        return;
    }
    constexpr std::size_t digits = 4; // of a number; those before say how often
    if (code == nullptr && rules_.programs == NumberedPrograms::fanuc && at == 0 && number.size() > digits) {
        times = std::stoll(number.substr(0, number.size() - digits));
        number.erase(0, number.size() - digits);
        number.erase(0, std::min(number.find_first_not_of('0'), digits - 1));
    }
    code = find_program(number, word, line);
    if (code != nullptr && times > 0) {
        frames_.push_back({.code = code, .at = 1, .call = Call::program, .more = times - 1});
    }
}

// Null: it waits for the input, or what is wrong with it has been told.
std::shared_ptr<const FlowBlock> ProgramFlow::find_program(const std::string& number, const FlowWord& word,
                                                           const SourceLine& line) {
    const std::string label = program_label(number);
    auto code = find_sub(label);
    if (code == nullptr && (lost_.contains(label) || wait_for_input(word, line))) {
        return nullptr;
    }
    if (code == nullptr) {
        fail(line, word.label_at, "there is no subprogram O{} behind this line; {}", number,
             files_.searched(file_names(label)));
    }
    if (frames_.size() >= deepest) {
        fail(line, word.label_at, "calls are nested more than {} deep", deepest);
    }
    return code;
}

// M99.
void ProgramFlow::leave_program(const FlowWord& word, const SourceLine& line) {
    if (!word.others.empty() && rules_.programs == NumberedPrograms::linuxcnc) {
        fail(line, word.label_at, "M99 stands alone in its line");
    }
    const bool is_main =
        std::ranges::all_of(frames_, [](const Frame& frame) { return frame.call == Call::none; }) && !passed_program_;
    if (is_main && word.has_number && rules_.macros) {
        jump(word, line, word.label_at);
        return;
    }
    if (word.has_number && !rules_.macros) {
        fail(line, word.label_at, "M99 P, which goes on at another line of the caller, is not supported");
    }
    if (is_main) { // controls begin the program again
        if (wait_for_input(word, line)) {
            return;
        }
        const auto rest = ahead_.begin() + static_cast<std::ptrdiff_t>(ahead_at_);
        if (std::any_of(rest, ahead_.end(), [](const SourceLine& later) { return has_program_end(later.text); })) {
            fail(line, word.label_at,
                 "M99 ends a subprogram that M98 has called; the main program, which M30 ends, stands first");
        }
        end_main(word, line);
        return;
    }
    leave_to(Call::program, word, line,
             "M99 ends a subprogram that M98 has called; the main program stands first, and M30 ends it");
    if (word.has_number) {
        return_to(word, line);
        return;
    }
    Frame& frame = frames_.back();
    if (frame.more == 0) {
        leave_frame();
        return;
    }
    require_same_locals(word, line);
    --frame.more;
    frame.at = frame.again;
    frame.repeats.clear();
}

// Null: it is not known, or stands behind its call in what has not been read. LinuxCNC takes a file before what follows
// in the program; where numbered programs are in one memory, the program's own come first.
std::shared_ptr<const FlowBlock> ProgramFlow::find_sub(const std::string& label) {
    if (const auto known = subs_.find(label); known != subs_.end()) {
        return known->second.code;
    }
    const bool own_first = rules_.programs == NumberedPrograms::fanuc && is_program_label(label);
    std::shared_ptr<const FlowBlock> out;
    for (const bool in_file : {!own_first, own_first}) {
        if (out == nullptr && !lost_.contains(label) && (ended_ || (in_file && !own_first))) {
            out = in_file ? find_file(label) : find_in(ahead_, ahead_at_, label);
        }
    }
    return out;
}

// As LinuxCNC names them: hole.ngc, 100.ngc; as Fanuc's and Haas' controls do: O1000.nc, O01000.nc.
std::vector<std::string> ProgramFlow::file_names(const std::string& label) const {
    const std::string name = label.substr(is_program_label(label) ? 1 : 0);
    if (!is_program_label(label) || rules_.programs != NumberedPrograms::fanuc) {
        return {name + ".ngc"};
    }
    std::vector<std::string> out{fmt::format("O{:0>4}.nc", name), fmt::format("O{:0>5}.nc", name)};
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

// Null: there is none, or what is wrong with it has been told.
std::shared_ptr<const FlowBlock> ProgramFlow::find_file(const std::string& label) {
    std::optional<SubprogramFiles::File> file;
    try {
        file = files_.read(file_names(label), most_lines);
    } catch (const InputError& error) {
        lost_.insert(label);
        throw WordError({}, 0, error.what());
    }
    auto code = file ? find_in(file->lines, 0, label) : nullptr;
    if (file && code == nullptr && lost_.insert(label).second) {
        throw WordError(file->name, 0, "there is no line {} in it, with which the subprogram would begin",
                        is_program_label(label) ? label : fmt::format("o<{}> sub", label));
    }
    return code;
}

std::optional<FlowWord> ProgramFlow::o_word(const std::string& text) const {
    std::size_t wrong = 0;
    return has_o_word(text) ? read_flow_word(text, wrong) : std::nullopt;
}

// From a line on. Null: it is not there, or what is wrong with it has been told.
std::shared_ptr<const FlowBlock> ProgramFlow::find_in(const Lines& lines, std::size_t begin, const std::string& label) {
    for (std::size_t i = begin; i < lines.size(); ++i) {
        const auto word = o_word(lines[i].text);
        if (!word || word->label != label || (word->kind != FlowKind::sub && word->kind != FlowKind::program)) {
            continue;
        }
        const std::size_t end = end_in(lines, i, *word);
        if (kept_ + (end - i) >= most_lines) {
            fail(lines[i], 0, "subprograms and loops have more than {} lines", most_lines);
        }
        if (lines[i].file == nullptr) {
            called_.emplace_back(i, end);
        }
        std::shared_ptr<const FlowBlock> block = block_of(lines, i, end);
        if (block == nullptr) {
            lost_.insert(label);
            return nullptr;
        }
        keep(label, {block, block->number(), 0});
        return block;
    }
    return nullptr;
}

// Without the words that are wrong, if problems are collected. Null: it has no end.
std::shared_ptr<const FlowBlock> ProgramFlow::block_of(const Lines& lines, std::size_t begin, std::size_t end) {
    auto block = std::make_shared<FlowBlock>(++blocks_);
    for (std::size_t i = begin; i < end; ++i) {
        add_to(*block, lines[i]);
    }
    if (report_problems(*block, block->link())) {
        return block;
    }
    if (block->place(0)->wrong) {
        return nullptr;
    }
    std::size_t first = 0;
    return rest_of(*block, first);
}

// Behind the last line of a subprogram: a numbered one ends where another one begins.
std::size_t ProgramFlow::end_in(const Lines& lines, std::size_t begin, const FlowWord& first) const {
    for (std::size_t i = begin + 1; i < lines.size(); ++i) {
        const std::string& text = lines[i].text;
        if (first.kind == FlowKind::program && TextCursor(text).peek() == '%') {
            return i;
        }
        const auto word = o_word(text);
        if (word && word->kind == FlowKind::program && first.kind == FlowKind::program) {
            return i;
        }
        if (word && word->kind == FlowKind::endsub && word->label == first.label) {
            return i + 1;
        }
    }
    return lines.size();
}

// False: there is no more.
bool ProgramFlow::wait_for_input(const FlowWord& word, const SourceLine& line) {
    if (!ended_) {
        waits_ = {word, line};
    }
    return !ended_;
}

// One line at a time, as whoever waits for a pipe wants to know after each.
ProgramFlow::Step ProgramFlow::read_ahead(SourceLine& out) {
    out.file = nullptr;
    if (lines_->next(out)) {
        if (ahead_.size() >= most_lines) {
            throw InputError(file_, waits_->line.number,
                             "more than {} lines follow this call, whose subprogram is looked for in them", most_lines);
        }
        ahead_.push_back(out);
        return Step::nothing;
    }
    ended_ = true;
    const Waiting call = *std::exchange(waits_, std::nullopt);
    out = call.line;
    try {
        begin(call.word, call.line);
    } catch (const WordError& error) {
        report(error, out);
    }
    return give_others(call.word, out);
}

// The words beside M98 and M99, which are executed before what these lead to.
ProgramFlow::Step ProgramFlow::give_others(const FlowWord& word, SourceLine& out) {
    if (!given_.empty()) {
        out.text = std::exchange(given_, {});
        return Step::line;
    }
    if (word.others.empty() || rules_.programs != NumberedPrograms::fanuc || waits_) {
        return Step::nothing;
    }
    out.text = word.others;
    return Step::line;
}

bool ProgramFlow::next_unread(SourceLine& out) {
    for (std::optional<FlowWord> word; next_line(out, word);) {
        const bool called = ended_ && std::ranges::any_of(called_, [this](const auto& part) {
                                return ahead_at_ > part.first && ahead_at_ <= part.second;
                            });
        if (!called) {
            return true;
        }
    }
    return false;
}

} // namespace splinefeed::host
