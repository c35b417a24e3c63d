// SPDX-License-Identifier: MIT
#include "support/golden.hpp"
#include "support/places.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>

namespace splinefeed_test {

using nlohmann::json;
using splinefeed::BezierPiece;
using splinefeed::PerAxis;
using splinefeed::host::CurveSample;
using splinefeed::host::DescribedCurve;

namespace {

double real(const json& value) {
    return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

double largest_of(const json& value) {
    if (value.is_array()) {
        double most = 0.0;
        for (const json& item : value) {
            most = std::max(most, largest_of(item));
        }
        return most;
    }
    return value.is_null() ? 0.0 : std::fabs(real(value));
}

bool is_real(const json& value) {
    return value.is_string() && value.get<std::string>().find_first_not_of("+-.0123456789e") == std::string::npos;
}

double length(const json& vector) {
    double sum = 0.0;
    for (const json& item : vector) {
        sum += real(item) * real(item);
    }
    return std::sqrt(sum);
}

class Comparison {
public:
    Comparison(const json& golden, const DescribedCurve& curve, double slack)
        : golden_(golden), curve_(curve), e_(slack * real(golden["tol_rel"]) * real(golden["scale"])),
          relative_(slack * real(golden["tol_rel"])) {}

    std::vector<std::string> run() {
        for (const auto& [key, expected] : golden_["expected"].items()) {
            if (key == "segments") {
                segments(expected);
            } else if (key == "joints") {
                joints(expected);
            } else if (const auto found = curve_.results.find(key); found == curve_.results.end()) {
                report(key, "is missing");
            } else {
                compare(key, json(*found), expected, tolerance_of(key, expected));
            }
        }
        return std::move(found_);
    }

private:
    void report(const std::string& where, const std::string& what) {
        if (found_.size() < 20) {
            found_.push_back(where + " " + what);
        }
    }

    double tolerance_of(const std::string& key, const json& expected) const {
        const bool parameters = key.find("params") != std::string::npos || key.find("knots") != std::string::npos ||
                                key == "matrix" || key == "schoenberg_whitney_slack" || key == "chords";
        if (key == "derivatives_ds") {
            double shortest = std::numeric_limits<double>::infinity();
            for (const json& chord : golden_["expected"]["chords"]) {
                shortest = std::min(shortest, real(chord));
            }
            return e_ / shortest;
        }
        return parameters ? relative_ * std::max(largest_of(expected), 1e-300) : e_;
    }

    void compare(const std::string& where, const json& actual, const json& expected, double tolerance) {
        if (expected.is_array() || expected.is_object()) {
            if (actual.type() != expected.type() || actual.size() != expected.size()) {
                report(where, fmt::format("has {} items, expected {}", actual.size(), expected.size()));
                return;
            }
            for (const auto& [key, value] : expected.items()) {
                const json* item = nullptr;
                if (expected.is_array()) {
                    item = &actual[std::stoul(key)];
                } else if (actual.contains(key)) {
                    item = &actual[key];
                } else {
                    report(where, "lacks " + key);
                    continue;
                }
                // gamma has no unit
                compare(fmt::format("{}.{}", where, key), *item, value,
                        key == "gamma" ? relative_ * std::max(1.0, largest_of(value)) : tolerance);
            }
        } else if (is_real(expected)) {
            number(where, actual, expected, tolerance);
        } else if (actual != expected) {
            report(where, fmt::format("is {}, expected {}", actual.dump(), expected.dump()));
        }
    }

    void number(const std::string& where, const json& actual, const json& expected, double tolerance) {
        if (!actual.is_number() || !(std::fabs(actual.get<double>() - real(expected)) <= tolerance)) {
            report(where,
                   fmt::format("is {}, expected {}, tolerance {:.3g}", actual.dump(), expected.dump(), tolerance));
        }
    }

    void point(const std::string& where, const PerAxis<double>& actual, const json& expected, double tolerance) {
        for (std::size_t k = 0; k < expected.size(); ++k) {
            number(where, actual[k], expected[k], tolerance);
        }
    }

    void segments(const json& expected) {
        if (curve_.pieces.size() != expected.size()) {
            report("segments", fmt::format("are {}, expected {}", curve_.pieces.size(), expected.size()));
            return;
        }
        for (std::size_t i = 0; i < expected.size(); ++i) {
            segment(fmt::format("segment {}", i), curve_.pieces[i], expected[i]);
            if (expected[i].contains("interval")) {
                interval(i, expected[i]["interval"], real(expected.back()["interval"][1]));
            }
        }
    }

    void interval(std::size_t i, const json& expected, double longest) {
        if (curve_.intervals.size() <= i) {
            report("interval", "is missing");
            return;
        }
        number("interval from", curve_.intervals[i].from, expected[0], relative_ * longest);
        number("interval to", curve_.intervals[i].to, expected[1], relative_ * longest);
    }

    void segment(const std::string& where, const BezierPiece<double>& piece, const json& expected) {
        if (piece.degree != expected["degree"].get<int>()) {
            report(where, fmt::format("has degree {}", piece.degree));
            return;
        }
        for (std::size_t i = 0; i < expected["control"].size(); ++i) {
            point(fmt::format("{} control {}", where, i), piece.point(static_cast<int>(i)), expected["control"][i], e_);
        }
        for (const json& row : expected["samples"]) {
            sample(fmt::format("{} u {}", where, row["u"].dump()),
                   splinefeed::host::sample_of(piece, curve_.axes, real(row["u"])), row, piece.degree);
        }
    }

    void sample(const std::string& where, const CurveSample& actual, const json& expected, int degree) {
        const double d = degree;
        point(where + " p", actual.point, expected["p"], e_);
        point(where + " d1", actual.first, expected["d1"], 2.0 * d * e_);
        point(where + " d2", actual.second, expected["d2"], std::max(1.0, 4.0 * d * (d - 1.0)) * e_);
        if (expected["kappa"].is_null()) {
            if (actual.regular) {
                report(where, "has a curvature, expected none");
            }
            return;
        }
        const double n = length(expected["d1"]);
        const double tolerance = (4.0 * d * std::max(d - 1.0, 1.0) +
                                  6.0 * d * (std::fabs(real(expected["kappa"])) * n + length(expected["d2"]) / n)) *
                                 e_ / (n * n);
        if (!actual.regular) {
            report(where, "has no curvature");
        }
        number(where + " kappa", actual.kappa, expected["kappa"], tolerance);
        point(where + " K", actual.curvature, expected["K"], tolerance);
    }

    // Classes and flags; the jumps are what the samples say.
    void joints(const json& expected) {
        const json& actual = curve_.results.at("joints");
        if (actual.size() != expected.size()) {
            report("joints", fmt::format("are {}, expected {}", actual.size(), expected.size()));
            return;
        }
        for (std::size_t i = 0; i < expected.size(); ++i) {
            for (const char* key : {"from", "to", "class", "C0", "C1", "C2", "regular", "G1", "G2", "abs_kappa"}) {
                if (actual[i].at(key) != expected[i].at(key)) {
                    report(fmt::format("joint {} {}", i, key),
                           fmt::format("is {}, expected {}", actual[i].dump(), expected[i].dump()));
                }
            }
        }
    }

    const json& golden_;
    const DescribedCurve& curve_;
    double e_;
    double relative_;
    std::vector<std::string> found_;
};

} // namespace

json golden_set(const std::string& file) {
    std::ifstream stream(splinefeed::test::source_folder() + "/tests/golden/" + file);
    return json::parse(stream);
}

std::vector<std::string> differences(const json& golden, const DescribedCurve& curve, double slack) {
    return Comparison(golden, curve, slack).run();
}

double control_error(const json& golden, const DescribedCurve& curve) {
    double most = 0.0;
    const json& segments = golden["expected"]["segments"];
    for (std::size_t i = 0; i < std::min(segments.size(), curve.pieces.size()); ++i) {
        const json& control = segments[i]["control"];
        for (std::size_t j = 0; j < control.size(); ++j) {
            for (std::size_t k = 0; k < control[j].size(); ++k) {
                most = std::max(most, std::fabs(curve.pieces[i].control[k][j] - real(control[j][k])));
            }
        }
    }
    return most / real(golden["scale"]);
}

} // namespace splinefeed_test
