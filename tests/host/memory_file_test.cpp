// SPDX-License-Identifier: MIT
#include "host_sim/base/memory_file.hpp"

#include "host_sim/base/text_file.hpp"

#include "support/catch.hpp"

#include <filesystem>

using namespace splinefeed::host;

TEST_CASE("a text in memory is a file that can be read again, as long as it exists") {
    std::string text;
    for (int i = 0; i < 200'000; ++i) {
        text += "G1 X" + std::to_string(i) + "\n";
    }
    std::string path;
    {
        const MemoryFile file(text);
        const MemoryFile empty("");
        path = file.path();
        CHECK(is_regular_file(path));
        CHECK(read_text_file(path, std::size_t{1} << 24) == text);
        CHECK(read_text_file(path, std::size_t{1} << 24) == text);
        CHECK(read_text_file(empty.path(), 1).empty());
    }
    CHECK_FALSE(std::filesystem::exists(path));
}
