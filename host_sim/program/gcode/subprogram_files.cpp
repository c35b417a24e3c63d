// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/subprogram_files.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/ranges.h>

namespace splinefeed::host {

namespace {

namespace fs = std::filesystem;

// What LinuxCNC's manual allows, and what controls call their programs. So no name leads to another folder.
bool is_plain(std::string_view name) {
    return name.size() <= SubprogramFiles::longest_name &&
           std::ranges::all_of(name.substr(0, name.rfind('.')), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                      c == '_';
           });
}

bool is_there(const std::string& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

} // namespace

// Behind all symbolic links.
std::string SubprogramFiles::inside(const std::string& path) const {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (error) {
        throw InputError(path, 0, "cannot be opened: {}", error.message());
    }
    const bool is_inside = std::ranges::any_of(folders_, [&](const std::string& folder) {
        const fs::path top = fs::canonical(folder.empty() ? "." : folder, error);
        return !error && std::ranges::mismatch(top, real).in1 == top.end();
    });
    if (!is_inside) {
        throw InputError(path, 0, "is a symbolic link that leads out of the folders of subprograms; copy the file");
    }
    if (!is_regular_file(real)) {
        throw InputError(path, 0, "is no file; a subprogram is read from a file");
    }
    return real;
}

SubprogramFiles::File SubprogramFiles::read_file(const std::string& path, const std::string& name,
                                                 std::size_t most_lines) {
    LineReader reader(inside(path), name);
    const std::string* const shown = &names_.emplace_back(name);
    File out{name, {}};
    for (SourceLine line; reader.next(line);) {
        bytes_ += line.text.size() + 1;
        if (bytes_ > most_bytes || out.lines.size() == most_lines) {
            throw InputError(name, line.number, "files of subprograms have more than {} bytes, or {} lines", most_bytes,
                             most_lines);
        }
        line.file = shown;
        out.lines.push_back(std::move(line));
    }
    return out;
}

std::optional<SubprogramFiles::File> SubprogramFiles::read(const std::vector<std::string>& names,
                                                           std::size_t most_lines) {
    for (const std::string& folder : folders_) {
        for (const std::string& name : names) {
            const std::string path = (fs::path(folder) / name).string();
            if (is_plain(name) && is_there(path)) {
                return read_file(path, path, most_lines);
            }
        }
    }
    return std::nullopt;
}

std::string SubprogramFiles::searched(const std::vector<std::string>& names) const {
    if (folders_.empty()) {
        return fmt::format("there is no folder to look for {} in; --subprograms states some", names.front());
    }
    if (!is_plain(names.front())) {
        return "no file can have this name: letters, digits, - and _ can stand in it";
    }
    std::vector<std::string> shown;
    for (const std::string& folder : folders_) {
        shown.push_back(in_quotes(folder.empty() ? "." : folder));
    }
    return fmt::format("no file {} is in {}", fmt::join(names, " or "), fmt::join(shown, ", "));
}

} // namespace splinefeed::host
