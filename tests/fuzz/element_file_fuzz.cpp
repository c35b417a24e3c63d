// SPDX-License-Identifier: MIT
// Any bytes as an element file: a path that chains, in each scalar, and keeps its tolerance, or one line that says what
// is wrong.
#include "fuzz/require.hpp"
#include "host_sim/base/json_text.hpp"
#include "host_sim/program/element_file.hpp"
#include "splinefeed/s1_blended_path/element_cast.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;
using splinefeed_test::require;

namespace {

constexpr int axes = 4;

template <Scalar S>
void require_chain(const ElementProgram& program) {
    constexpr std::size_t most_segments = 100'000; // of arcs with many turns
    TolerancePath<S> path(axes, {from_double<S>(0.001)});
    require(path.start(program.start()).ok());
    PerAxis<Position> here = program.start();
    CurveSegment<S> segment;
    std::size_t pushed = 0;
    std::size_t segments = 0;
    bool ended = false;
    for (Pull pull = Pull::starved; pull != Pull::finished && segments < most_segments;) {
        pull = path.next(segment);
        if (pull == Pull::item) {
            for (unsigned k = 0; k < axes; ++k) {
                require(segment.degree != 1 || segment.origin[k] == here[k]);
            }
            here = segment.end;
            ++segments;
        } else if (pull == Pull::starved) {
            require(!ended);
            ended = pushed == program.moves() || !path.push(element_cast<S>(program.element(pushed++))).ok();
            if (ended) {
                static_cast<void>(path.finish());
            }
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return splinefeed_test::read_or_refuse(data, size, [](std::string_view text) {
        const nlohmann::json document = parse_json(text, "fuzz.json");
        if (!has_elements(document)) {
            return;
        }
        const std::vector<std::string> names = text.size() % 3 == 0 ? std::vector<std::string>{"x", "y", "z", "a"}
                                                                    : std::vector<std::string>{"y", "x", "a", "z"};
        const ElementProgram program = read_elements(document, "fuzz.json", names, {});
        require_chain<double>(program);
        require_chain<float>(program);
        require_chain<Fixed>(program);
    });
}
