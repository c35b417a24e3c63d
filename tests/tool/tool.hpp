// SPDX-License-Identifier: MIT
// Tool: calls the built program `splinefeed` and takes what it says.
#pragma once

#include "support/places.hpp"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace splinefeed::test {

/// What became of a call.
struct Call {
    int status = -1;
    std::string output;
    std::string error;
};

/// A folder of its own to work in; removed at the end.
class Tool {
public:
    Tool() {
        std::string name = (std::filesystem::temp_directory_path() / "splinefeed-tool-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;
    ~Tool() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    /// Runs `splinefeed ARGUMENTS` in the folder; the shell reads the arguments.
    [[nodiscard]] Call operator()(const std::string& arguments) const {
        return shell("'" + splinefeed::test::tool_path() + "' " + arguments);
    }

    [[nodiscard]] Call shell(const std::string& command) const {
        const std::string all = "cd '" + folder_.string() + "' && { " + command + " ; } >.out 2>.err";
        const int status = std::system(all.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }

    [[nodiscard]] std::string folder() const { return folder_.string(); }

    [[nodiscard]] std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }

    /// Whether a call left anything behind but what was there: files named in `known` and those of this class.
    [[nodiscard]] bool holds_only(const std::string& known) const {
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            const std::string name = entry.path().filename().string();
            if (name != ".out" && name != ".err" && (" " + known + " ").find(" " + name + " ") == std::string::npos) {
                return false;
            }
        }
        return true;
    }

private:
    std::filesystem::path folder_;
};

inline std::string path_text(int max_feed_mm_s) {
    return "[path]\nmax_feed_mm_s = " + std::to_string(max_feed_mm_s) + "\n";
}

/// Of a machine file, for 100 mm/s and 1000 mm/s^2. @param more  its other lines
inline std::string axis_text(const std::string& name, const std::string& more = "") {
    return "[[axis]]\nname = '" + name + "'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n" + more;
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Where the last feed segment of a file ends, in its integers.
inline std::vector<std::string> last_positions(const Tool& tool, const std::string& file) {
    std::istringstream in(tool.read(file));
    std::string header;
    std::string last;
    for (std::string row; std::getline(in, row);) {
        if (row.rfind("index,", 0) == 0) {
            header = row;
        }
        last = row;
    }
    std::vector<std::string> ends;
    std::istringstream names(header);
    std::istringstream fields(last);
    std::string field;
    for (std::string name; std::getline(names, name, ',') && std::getline(fields, field, ',');) {
        if (name.find("_end") != std::string::npos) {
            ends.push_back(name + "=" + field);
        }
    }
    return ends;
}

} // namespace splinefeed::test
