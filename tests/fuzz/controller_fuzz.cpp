// SPDX-License-Identifier: MIT
// Any bytes to a controller, with pauses: it never crashes, never leaves travel or a limit, moves by complete lines
// alone, and answers each line exactly once.
#include "support/virtual_machine_tool.hpp"

#include "fuzz/bytes.hpp"

#include <cstdio>
#include <cstdlib>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

[[noreturn]] void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

std::size_t count(std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

// Lines of what was said that answer one.
std::size_t answers_of(std::string_view text) {
    return count(text, "\r\nok\r\n") + count(text, "\r\nerror:");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    splinefeed_test::Bytes bytes{data, size < 400 ? size : 400};
    ControlledTool<double> tool;
    tool.text = "\r\n";
    tool.machine.plate = -20.0;
    tool.settings.holds_on_error = bytes.left == 0 || bytes.take() % 2 == 0;
    std::size_t lines = 0;
    bool counts = true; // a reset forgets answers that are due
    bool after_return = false;
    while (bytes.left > 0) {
        const char c = static_cast<char>(bytes.take());
        const bool pauses = c == '\x01';
        const bool ends = c == '\r' || (c == '\n' && !after_return);
        if (realtime_byte(static_cast<std::uint8_t>(c)).kind == RealtimeKind::none) {
            after_return = c == '\r';
        }
        lines += ends ? 1U : 0U;
        counts = counts && c != '\x18' && c != '\x19';
        tool.send({&c, 1});
        for (int ms = pauses ? 64 : ends ? 1 : 0; ms > 0; --ms) {
            tool.tick();
        }
        if (lines == 0 && tool.machine.distance_mm() > 0.0) {
            fail("it moves without a line");
        }
    }
    if (!counts) {
        for (int ms = 0; ms < 50; ++ms) {
            tool.tick();
        }
        return 0;
    }
    tool.send("\r"); // a comment that has no end would hide what follows
    ++lines;
    for (int s = 0; s < 40 && answers_of(tool.text) < lines; ++s) {
        tool.send("~");
        for (int ms = 0; ms < 1000; ++ms) {
            tool.tick();
        }
    }
    const std::size_t answers = answers_of(tool.text);
    if (answers > lines) {
        fail("more answers than lines");
    }
    const ControllerState state = tool.controller->state();
    const bool works = state == ControllerState::run || state == ControllerState::jog; // a long dwell, a slow feed
    if (answers < lines && !works && state != ControllerState::door) {
        fail("a line without an answer");
    }
    return 0;
}
