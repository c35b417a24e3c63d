// SPDX-License-Identifier: MIT
// Any bytes as a curve file: segments that chain, from each scalar, or one line that says what is wrong.
#include "fuzz/require.hpp"
#include "host_sim/curve/bezier_source.hpp"
#include "host_sim/curve/curve_file.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

template <Scalar S>
void require_chain(const CurveFile& file) {
    BezierSource<S> source(file, file.axes);
    CurveSegment<S> segment;
    PerAxis<Position> here{};
    bool first = true;
    while (source.next(segment) == Pull::item) {
        for (const unsigned k : indices(file.axes)) {
            splinefeed_test::require(first || segment.origin[k] == here[k]);
        }
        here = segment.end;
        first = false;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return splinefeed_test::read_or_refuse(data, size, [](std::string_view text) {
        const auto scalar = static_cast<ScalarKind>(text.size() % 3);
        const CurveFile file = parse_curve(text, "fuzz.json", scalar);
        if (file.described) {
            require_executable(file, "fuzz.json");
        }
        require_chain<double>(file);
        require_chain<float>(file);
        require_chain<Fixed>(file);
    });
}
