// SPDX-License-Identifier: MIT
#include "support/conformance_list.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinefeed::test {

namespace {

/// \n, \r, \t, \\ and \xHH.
std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            out += text[i];
            continue;
        }
        const char c = text.at(++i);
        if (c == 'x') {
            out += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            out += c == 'n' ? '\n' : c == 'r' ? '\r' : c == 't' ? '\t' : c;
        }
    }
    return out;
}

/// * stands for any text.
bool matches(std::string_view pattern, std::string_view line) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
        return pattern == line;
    }
    if (line.substr(0, star) != pattern.substr(0, star)) {
        return false;
    }
    for (std::size_t from = star; from <= line.size(); ++from) {
        if (matches(pattern.substr(star + 1), line.substr(from))) {
            return true;
        }
    }
    return false;
}

/// What a case needs to go on does not happen.
struct CaseFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Case {
public:
    explicit Case(std::unique_ptr<ListedMachine> machine) : machine_(std::move(machine)) {}

    void run(const std::string& command, const std::string& rest) {
        if (command == ">") {
            machine_->send(unescaped(rest));
            wait(1);
        } else if (command == "times") {
            const std::size_t space = rest.find(' ');
            for (int n = std::stoi(rest.substr(0, space)); n > 0; --n) {
                machine_->send(unescaped(rest.substr(space + 1)));
            }
        } else if (command == "<") {
            expect(rest);
        } else if (command == "wait") {
            wait(std::stoi(rest));
        } else if (command == "until") {
            until(rest);
        } else if (command == "at") {
            require_place(rest);
        } else if (command == "connect") {
            machine_->controller().connect();
        } else if (command == "disconnect") {
            machine_->controller().disconnect();
        } else {
            machine_->obey(command, rest);
        }
    }
    void finish() {
        wait(300);
        CHECK(std::string(left()) == "");
        machine_->finish();
    }

private:
    [[nodiscard]] std::string_view left() const { return std::string_view(machine_->text()).substr(seen_); }
    void wait(int ms) {
        for (; ms > 0; --ms) {
            machine_->tick();
        }
    }
    std::string next_line() {
        for (int ms = 0; left().find('\n') == std::string_view::npos && ms < 20000; ++ms) {
            machine_->tick();
        }
        const std::size_t end = left().find('\n');
        if (end == std::string_view::npos) {
            return "(nothing more: " + std::string(left()) + ")";
        }
        const std::string line(left().substr(0, end + 1));
        seen_ += end + 1;
        REQUIRE(line.size() >= 2);
        CHECK(line[line.size() - 2] == '\r');
        return line.substr(0, line.size() - 2);
    }
    void expect(const std::string& pattern) {
        const std::string line = next_line();
        if (!matches(pattern, line)) {
            throw CaseFailed("it said: " + line);
        }
    }
    // A report that the case does not see.
    std::string report() {
        const std::size_t before = machine_->text().size();
        machine_->send("?");
        wait(1);
        const std::size_t begin = machine_->text().find('<', before);
        REQUIRE(begin != std::string::npos);
        const std::size_t end = machine_->text().find('\n', begin) + 1;
        const std::string line = machine_->text().substr(begin, end - begin - 2);
        machine_->text().erase(begin, end - begin);
        return line;
    }
    void until(const std::string& state) {
        std::string line;
        for (int tries = 0; tries < 3000; ++tries) {
            line = report();
            if (line.compare(1, state.size(), state) == 0 && line[1 + state.size()] == '|') {
                return;
            }
            wait(19);
        }
        throw CaseFailed("never " + state + ": " + line);
    }
    void require_place(const std::string& rest) {
        const std::string line = report();
        std::istringstream said(line.substr(line.find("Pos:") + 4));
        std::istringstream wanted(rest);
        double value = 0.0;
        double given = 0.0;
        INFO(line);
        while (wanted >> value) {
            said >> given;
            CHECK(given == Approx(value).margin(0.0015));
            said.ignore(1);
        }
    }
    std::unique_ptr<ListedMachine> machine_;
    std::size_t seen_ = 0;
};

struct ListedLine {
    int number = 0;
    std::string command;
    std::string rest;
};
struct ListedCase {
    std::string name;
    std::vector<ListedLine> lines{};
};

std::vector<ListedCase> read_list() {
    std::ifstream file(source_folder() + "/tests/controller/conformance.txt");
    REQUIRE(file.good());
    std::vector<ListedCase> cases;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line[0] == '#') {
            continue;
        }
        const std::size_t space = line.find(' ');
        const std::string command = line.substr(0, space);
        const std::string rest = space == std::string::npos ? "" : line.substr(space + 1);
        if (command == "case") {
            cases.push_back({rest});
        } else {
            REQUIRE(!cases.empty());
            cases.back().lines.push_back({number, command, rest});
        }
    }
    return cases;
}

} // namespace

int run_conformance_list(const std::function<std::unique_ptr<ListedMachine>()>& make,
                         const std::function<bool(const std::string&, const std::string&)>& takes) {
    int run = 0;
    for (const ListedCase& each : read_list()) {
        if (!std::all_of(each.lines.begin(), each.lines.end(),
                         [&](const ListedLine& line) { return takes(line.command, line.rest); })) {
            continue;
        }
        ++run;
        Case present(make());
        try {
            for (const ListedLine& line : each.lines) {
                INFO("case: " << each.name << ", line " << line.number << ": " << line.command << " " << line.rest);
                if (line.command != "needs") {
                    present.run(line.command, line.rest);
                }
            }
            INFO("case: " << each.name);
            present.finish();
        } catch (const std::exception& failure) {
            FAIL_CHECK("case: " << each.name << ": " << failure.what());
        }
    }
    return run;
}

} // namespace splinefeed::test
