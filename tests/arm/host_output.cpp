// SPDX-License-Identifier: MIT
// The proof program's output on the host.
#include "platform.hpp"

#include <cstdio>

void write_text(const char* text) {
    std::fputs(text, stdout);
}
