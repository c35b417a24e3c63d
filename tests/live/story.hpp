// SPDX-License-Identifier: MIT
// The stories of stories.txt and shaft_stories.txt: for which door and which targets each is told, and its steps.
#pragma once

#include "support/places.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace splinefeed_test {

struct Step {
    std::string at{}; ///< "stories.txt:7"
    bool at_once = false;
    std::string text{};
};

struct Story {
    std::string door; ///< run, serve, both
    std::string targets;
    int times = 1; ///< it is told, with other dice
    std::string name;
    std::vector<Step> steps{};

    /// So many are in its longest choice, of which each round takes the next: {this|that}.
    [[nodiscard]] int ways() const {
        std::ptrdiff_t most = 0;
        for (const Step& step : steps) {
            for (std::size_t at = 0; (at = step.text.find('{', at)) != std::string::npos; ++at) {
                const std::string choice = step.text.substr(at, step.text.find('}', at) - at);
                most = std::max(most, std::ranges::count(choice, '|'));
            }
        }
        return static_cast<int>(most) + 1;
    }
    [[nodiscard]] bool holds(bool serves, const std::vector<std::string>& target) const {
        return door != (serves ? "run" : "serve") && std::ranges::any_of(target, [this](const std::string& one) {
                   return (" " + targets + " ").find(" " + one + " ") != std::string::npos;
               });
    }
};

/// "DOOR [on TARGET ..] [N times]: NAME"
inline Story story_of(const std::string& head, const std::string& name) {
    Story out;
    out.name = name;
    std::istringstream words(head);
    words >> out.door;
    for (std::string word, before; words >> word; before = word) {
        if (word == "times") {
            out.times = std::stoi(before);
            out.targets.resize(out.targets.size() - before.size() - 1);
        } else if (word != "on") {
            out.targets += (out.targets.empty() ? "" : " ") + word;
        }
    }
    out.targets = out.targets.empty() ? "talking" : out.targets == "all" ? "sim lines pvt setpoint" : out.targets;
    return out;
}

/// The head of a story, or some of its steps.
inline void read_line(std::vector<Story>& out, const std::string& at, const std::string& line) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos && line[0] != ' ' && line[0] != '#') {
        out.push_back(story_of(line.substr(0, colon), line.substr(colon + 2)));
    }
    std::istringstream words(line[0] == ' ' ? "|" + line : "");
    for (std::string word; words >> word;) {
        if (word == "|" || word == "+") {
            out.back().steps.push_back({at, word == "+"});
        } else {
            std::string& text = out.back().steps.back().text;
            text += (text.empty() ? "" : " ") + word;
        }
    }
}

inline std::vector<Story> read_stories() {
    std::vector<Story> out;
    const std::string folder = splinefeed::test::source_folder() + "/tests/live/";
    for (const std::string name : {"stories.txt", "shaft_stories.txt"}) {
        std::ifstream in(folder + name);
        std::string line;
        for (int number = 1; std::getline(in, line); ++number) {
            read_line(out, name + ":" + std::to_string(number), line);
        }
    }
    return out;
}

} // namespace splinefeed_test
