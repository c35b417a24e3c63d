// SPDX-License-Identifier: MIT
// The only library functions that the compiler may ask for: a firmware without a C library brings these.
#include <cstddef>
#include <cstdint>

namespace {

using Word [[gnu::may_alias]] = std::uint32_t;

// Whether a call moves whole words: cells and segments, which are what a planner copies, are aligned to them.
bool aligned(const void* first, const void* second) {
    return ((reinterpret_cast<std::uintptr_t>(first) | reinterpret_cast<std::uintptr_t>(second)) % sizeof(Word)) == 0;
}

} // namespace

extern "C" {

void* memcpy(void* to, const void* from, std::size_t size) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    if (aligned(to, from)) {
        // Two words a turn: the counting costs as much as a copy.
        for (; size >= 2 * sizeof(Word); size -= 2 * sizeof(Word)) {
            const Word first = reinterpret_cast<const Word*>(in)[0];
            const Word second = reinterpret_cast<const Word*>(in)[1];
            reinterpret_cast<Word*>(out)[0] = first;
            reinterpret_cast<Word*>(out)[1] = second;
            in += 2 * sizeof(Word);
            out += 2 * sizeof(Word);
        }
    }
    for (; size > 0; --size) {
        *out++ = *in++;
    }
    return to;
}

void* memmove(void* to, const void* from, std::size_t size) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    // memcpy goes upwards and reads two words before it writes them, so it may be used downwards.
    if (out <= in) {
        return memcpy(to, from, size);
    }
    for (std::size_t i = size; i > 0; --i) {
        out[i - 1] = in[i - 1];
    }
    return to;
}

void* memset(void* to, int value, std::size_t size) {
    auto* out = static_cast<unsigned char*>(to);
    const auto byte = static_cast<unsigned char>(value);
    if (aligned(to, to)) {
        const Word word = byte * 0x01010101U;
        for (; size >= 2 * sizeof(Word); size -= 2 * sizeof(Word)) {
            reinterpret_cast<Word*>(out)[0] = word;
            reinterpret_cast<Word*>(out)[1] = word;
            out += 2 * sizeof(Word);
        }
    }
    for (; size > 0; --size) {
        *out++ = byte;
    }
    return to;
}

} // extern "C"
