// SPDX-License-Identifier: MIT
//
// The firmware's own library functions, under other names beside those of the host, which are what they must equal.
#include <array>
#include <cstring>
#include <numeric>
#include <support/catch.hpp>

#define memcpy board_memcpy
#define memmove board_memmove
#define memset board_memset
#include "memory.cpp" // NOLINT(bugprone-suspicious-include)
#undef memcpy
#undef memmove
#undef memset

namespace {

using Bytes = std::array<unsigned char, 96>;

Bytes numbered_bytes() {
    Bytes bytes{};
    std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(1));
    return bytes;
}

/// Calls both for every size and every distance of both ends from a border of words.
template <class Check>
void for_all_places(Check check) {
    for (std::size_t size = 0; size <= 40; ++size) {
        for (std::size_t to = 0; to < 9; ++to) {
            for (std::size_t from = 0; from < 9; ++from) {
                check(to, from, size);
            }
        }
    }
}

} // namespace

TEST_CASE("Board memory: copies what it is asked to and nothing beside it", "[memory]") {
    for_all_places([](std::size_t to, std::size_t from, std::size_t size) {
        alignas(8) const Bytes source = numbered_bytes();
        alignas(8) Bytes copy{};
        alignas(8) Bytes expected{};
        std::memcpy(expected.data() + 8 + to, source.data() + from, size);
        REQUIRE(board_memcpy(copy.data() + 8 + to, source.data() + from, size) == copy.data() + 8 + to);
        REQUIRE(copy == expected);
    });
}

TEST_CASE("Board memory: moves within itself, up and down", "[memory]") {
    for_all_places([](std::size_t to, std::size_t from, std::size_t size) {
        alignas(8) Bytes moved = numbered_bytes();
        alignas(8) Bytes expected = numbered_bytes();
        std::memmove(expected.data() + to, expected.data() + from, size);
        REQUIRE(board_memmove(moved.data() + to, moved.data() + from, size) == moved.data() + to);
        REQUIRE(moved == expected);
    });
}

TEST_CASE("Board memory: fills with one byte", "[memory]") {
    for_all_places([](std::size_t to, std::size_t value, std::size_t size) {
        alignas(8) Bytes filled = numbered_bytes();
        alignas(8) Bytes expected = numbered_bytes();
        const int byte = static_cast<int>(0x1f8 + value); // only its lowest eight bits count
        std::memset(expected.data() + to, byte & 0xff, size);
        REQUIRE(board_memset(filled.data() + to, byte, size) == filled.data() + to);
        REQUIRE(filled == expected);
    });
}
