// SPDX-License-Identifier: MIT
#include "host_sim/base/text_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/input_stream.hpp"
#include "host_sim/base/plain_text.hpp"

#include <array>
#include <filesystem>
#include <ios>

namespace splinefeed::host {

std::string read_text_file(const std::string& path, std::size_t largest, const std::string& name) {
    const std::string& shown = name.empty() ? path : name;
    InputStream input(path, shown);
    std::string text;
    std::array<char, 65536> block{};
    try {
        for (std::streamsize count = 0; (count = input.sgetn(block.data(), block.size())) > 0;) {
            text.append(block.data(), static_cast<std::size_t>(count));
            if (text.size() > largest) {
                throw InputError(shown, 0, "is larger than the {} bytes that such a file may have", largest);
            }
        }
    } catch (const std::ios_base::failure&) {
        throw InputError(shown, 0, "cannot be read; it must be a file or a pipe");
    }
    return std::string(plain_text(text, shown));
}

bool is_regular_file(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

} // namespace splinefeed::host
