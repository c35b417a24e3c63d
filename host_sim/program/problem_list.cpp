// SPDX-License-Identifier: MIT
#include "host_sim/program/problem_list.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

// Behind "FILE:LINE:COLUMN: ".
std::string_view without_place(std::string_view text, std::uint64_t line) {
    const std::size_t at = line > 0 ? text.find(fmt::format(":{}:", line)) : std::string_view::npos;
    const std::size_t end = at == std::string_view::npos ? at : text.find(": ", at + 1);
    return end == std::string_view::npos ? text : text.substr(end + 2);
}

} // namespace

bool ProblemList::add(const InputError& error, std::uint64_t line, std::string_view cause, std::string_view file) {
    const std::string_view key = cause.empty() ? without_place(error.what(), line) : cause;
    auto found = numbers_.find(key);
    if (found == numbers_.end()) {
        if (causes_.size() == most_causes) {
            ++count_;
            ++untold_;
            return true;
        }
        found = numbers_.emplace(key, causes_.size()).first;
        causes_.push_back({error.what(), std::string(file), {}, 0});
    }
    Cause& of = causes_[found->second];
    const std::string place = file == of.file ? std::to_string(line) : fmt::format("{}:{}", file, line);
    if (!places_.emplace(place, found->second).second) {
        return false;
    }
    if (of.count > 0 && of.places.size() < most_places) {
        of.places.push_back(place);
    }
    ++of.count;
    ++count_;
    return true;
}

std::vector<std::string> ProblemList::texts() const {
    std::vector<std::string> out;
    for (const Cause& cause : causes_) {
        const std::uint64_t more = cause.count - 1 - cause.places.size();
        std::string text = cause.first;
        for (std::size_t i = 0; i < cause.places.size(); ++i) {
            const bool is_last = more == 0 && i + 1 == cause.places.size();
            text += i == 0 ? (cause.count > 2 ? "; also on lines " : "; also on line ") : is_last ? " and " : ", ";
            text += cause.places[i];
        }
        out.push_back(more > 0 ? fmt::format("{} and {} more", text, more) : text);
    }
    if (untold_ > 0) {
        out.push_back(
            fmt::format("{} more problems of other causes are not listed: {} causes are enough", untold_, most_causes));
    }
    return out;
}

} // namespace splinefeed::host
