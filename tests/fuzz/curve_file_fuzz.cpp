// SPDX-License-Identifier: MIT
// Any bytes as a curve file: segments that chain, from each scalar, or one line that says what is wrong.
#include "host_sim/base/input_error.hpp"
#include "host_sim/curve/bezier_source.hpp"
#include "host_sim/curve/curve_file.hpp"

#include <cstdlib>
#include <string_view>

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
            if (!first && segment.origin[k] != here[k]) {
                std::abort();
            }
        }
        here = segment.end;
        first = false;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto scalar = static_cast<ScalarKind>(size % 3);
        const CurveFile file = parse_curve({reinterpret_cast<const char*>(data), size}, "fuzz.json", scalar);
        if (file.described) {
            require_executable(file, "fuzz.json");
        }
        require_chain<double>(file);
        require_chain<float>(file);
        require_chain<Fixed>(file);
    } catch (const InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) {
            std::abort();
        }
    }
    return 0;
}
