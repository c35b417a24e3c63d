// SPDX-License-Identifier: MIT
#include "text_file.hpp"

#include "input_error.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>

namespace splinefeed::host {

std::string read_text_file(const std::string& path, std::size_t largest) {
    std::ifstream file;
    if (path != "-") {
        errno = 0;
        file.open(path, std::ios::binary);
        if (!file) {
            throw InputError(path, 0, fmt::format("cannot be opened: {}", std::strerror(errno)));
        }
    }
    std::istream& input = path == "-" ? std::cin : file;
    std::string text;
    std::array<char, 65536> block{};
    while (input.read(block.data(), static_cast<std::streamsize>(block.size())) || input.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(input.gcount()));
        if (text.size() > largest) {
            throw InputError(path, 0, fmt::format("is larger than the {} bytes that such a file may have", largest));
        }
    }
    if (input.bad()) {
        throw InputError(path, 0, "cannot be read; it must be a file or a pipe");
    }
    return text;
}

bool is_regular_file(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

} // namespace splinefeed::host
