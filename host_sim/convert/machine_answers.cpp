// SPDX-License-Identifier: MIT
#include "host_sim/convert/machine_answers.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_answers = std::size_t{1} << 16U;

/// As a person types it.
std::string typed_text(const toml::node& node) {
    if (const toml::array* const array = node.as_array()) {
        std::string out;
        for (const toml::node& part : *array) {
            out += (out.empty() ? "" : " ") + typed_text(part);
        }
        return out;
    }
    const std::optional<double> number = node.value<double>();
    return number ? short_number(*number) : node.value_or(std::string());
}

/// False: there is none.
bool read_answer(std::string& line) {
    line.clear();
    for (int c = 0; (c = std::getc(stdin)) != '\n';) {
        if (c == EOF) {
            return false;
        }
        line += static_cast<char>(c);
    }
    return true;
}

} // namespace

MachineAnswers::MachineAnswers(std::string file, const std::string& answers)
    : source_(AnswerSource::file), file_(std::move(file)), answers_(answers) {
    const toml::table document = parse_toml(read_text_file(answers, largest_answers), answers);
    const std::function<void(const toml::table&, const std::string&)> add = [&](const toml::table& table,
                                                                                const std::string& before) {
        for (const auto& [name, node] : table) {
            const std::string key = before + std::string(name.str());
            if (const toml::table* const inner = node.as_table()) {
                add(*inner, key + ".");
            } else {
                given_.emplace(key, Given{typed_text(node), node.source().begin.line});
            }
        }
    };
    add(document, "");
}

void MachineAnswers::ask(const MachineQuestion& question, const Take& take) {
    asked_.push_back(question.key);
    if (source_ == AnswerSource::terminal) {
        ask_terminal(question, take);
        return;
    }
    const auto given = given_.find(question.key);
    if (given == given_.end()) {
        add_missing(question);
    } else if (const std::string why = take(given->second.text); !why.empty()) {
        throw InputError(answers_, given->second.line, "{} is {}: {}", question.key, in_quotes(given->second.text),
                         why);
    }
}

void MachineAnswers::ask_terminal(const MachineQuestion& question, const Take& take) {
    for (std::string line; source_ == AnswerSource::terminal;) {
        tell("{} (Enter: {}) ", question.text, question.without);
        if (!read_answer(line)) { // Ctrl-D: no more questions
            tell("\n");
            source_ = AnswerSource::nobody;
        } else {
            const std::string why = trimmed(line).empty() ? std::string() : take(trimmed(line));
            if (why.empty()) {
                return;
            }
            tell("{}: {}\n", in_quotes(trimmed(line)), why);
        }
    }
    add_missing(question);
}

void MachineAnswers::add_missing(const MachineQuestion& question) {
    missing_.push_back(fmt::format("{} does not say {}: {}", printable(file_), question.key, question.without));
}

void MachineAnswers::close() const {
    for (const auto& [key, given] : given_) {
        if (std::ranges::find(asked_, key) == asked_.end()) {
            throw InputError(answers_, given.line, "nobody asks for {}; the questions are: {}", in_quotes(key),
                             asked_.empty() ? "none" : fmt::format("{}", fmt::join(asked_, ", ")));
        }
    }
}

} // namespace splinefeed::host
