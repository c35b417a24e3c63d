// SPDX-License-Identifier: MIT
#include "host_sim/output/curve_writer.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

CurveSegment<double> sample_segment(int axes, int degree) {
    CurveSegment<double> segment;
    segment.axes = axes;
    segment.degree = degree;
    segment.unit_log2 = -13;
    for (const unsigned k : indices(axes)) {
        segment.origin[k] = position_from_mm(1.0 / 3.0 + 100.0 * k);
        for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
            segment.control[k][i] = 40000.0 / 7.0 * i - 0.1 * k;
        }
    }
    return segment;
}

} // namespace

TEST_CASE("a curve is written to the last bit") {
    const TemporaryFolder folder;
    OutputFile file(folder.file("c.json"));
    CurveWriter writer(file, "g2");
    const std::vector<CurveSegment<double>> segments = {sample_segment(3, 3), sample_segment(1, 1),
                                                        sample_segment(6, 9)};
    for (const auto& segment : segments) {
        writer.segment(segment);
    }
    writer.finish();
    file.commit();

    const nlohmann::json curve = nlohmann::json::parse(contents(folder.file("c.json")));
    CHECK(curve.size() == 3);
    CHECK(curve.at("curve") == "g2");
    CHECK(curve.at("closed") == false);
    REQUIRE(curve.at("segments").size() == segments.size());
    for (std::size_t n = 0; n < segments.size(); ++n) {
        const nlohmann::json& written = curve["segments"][n];
        CHECK(written.at("degree") == segments[n].degree);
        const auto points = written.at("control_points").get<std::vector<std::vector<double>>>();
        REQUIRE(points.size() == static_cast<std::size_t>(segments[n].degree) + 1U);
        for (std::size_t i = 0; i < points.size(); ++i) {
            REQUIRE(points[i].size() == static_cast<std::size_t>(segments[n].axes));
            for (std::size_t k = 0; k < points[i].size(); ++k) {
                CHECK(points[i][k] == segments[n].control_mm(static_cast<int>(k), static_cast<int>(i)));
            }
        }
    }
    CHECK(lines_of(folder.file("c.json")).size() == segments.size() + 2);
}

TEST_CASE("a curve without segments, closed, with a name that needs quoting") {
    const TemporaryFolder folder;
    OutputFile file(folder.file("c.json"));
    CurveWriter writer(file, "a \"b\"", true);
    writer.finish();
    file.commit();
    const nlohmann::json curve = nlohmann::json::parse(contents(folder.file("c.json")));
    CHECK(curve == nlohmann::json::parse(R"({"curve": "a \"b\"", "closed": true, "segments": []})"));
}

TEST_CASE("further results are keys of the top level") {
    const TemporaryFolder folder;
    OutputFile file(folder.file("c.json"));
    CurveWriter writer(file, "bspline");
    writer.segment(sample_segment(2, 3));
    CHECK_THROWS_AS(writer.finish(nlohmann::json::array()), std::invalid_argument);
    CHECK_THROWS_AS(writer.finish({{"closed", true}}), std::invalid_argument);
    writer.finish({{"knots", {0.0, 1.0 / 3.0, 1.0}}, {"degree", 3}});
    file.commit();
    const nlohmann::json curve = nlohmann::json::parse(contents(folder.file("c.json")));
    CHECK(curve.size() == 5);
    CHECK(curve.at("knots").at(1) == 1.0 / 3.0);
    CHECK(curve.at("degree") == 3);
    CHECK(curve.at("segments").size() == 1);
}
