// SPDX-License-Identifier: MIT
#include "host_sim/program/hermite_pieces.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::size_t most_pieces = 4096;
constexpr int checked_places = 8;

std::array<Vector3, 6> quintic(const CurveState& a, const CurveState& b, double h) {
    std::array<Vector3, 6> points{};
    for (std::size_t k = 0; k < 3; ++k) {
        points[0][k] = a.point[k];
        points[1][k] = a.point[k] + h * a.first[k] / 5.0;
        points[2][k] = a.point[k] + 2.0 * h * a.first[k] / 5.0 + h * h * a.second[k] / 20.0;
        points[3][k] = b.point[k] - 2.0 * h * b.first[k] / 5.0 + h * h * b.second[k] / 20.0;
        points[4][k] = b.point[k] - h * b.first[k] / 5.0;
        points[5][k] = b.point[k];
    }
    return points;
}

Vector3 point_of(std::array<Vector3, 6> points, double t) {
    for (std::size_t last = 5; last > 0; --last) {
        for (std::size_t i = 0; i < last; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                points[i][k] += t * (points[i + 1][k] - points[i][k]);
            }
        }
    }
    return points[0];
}

double error_of(const std::function<CurveState(double)>& curve, const HermitePiece& piece) {
    double worst = 0.0;
    for (int i = 1; i <= checked_places; ++i) {
        const double t = i / (checked_places + 1.0);
        const Vector3 want = curve(piece.from + t * (piece.to - piece.from)).point;
        const Vector3 have = point_of(piece.points, t);
        worst = std::fmax(worst, std::hypot(want[0] - have[0], want[1] - have[1], want[2] - have[2]));
    }
    return worst;
}

} // namespace

std::vector<HermitePiece> hermite_pieces(const std::function<CurveState(double)>& curve,
                                         const std::vector<double>& breaks) {
    std::vector<HermitePiece> done;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        std::vector<double> ends{breaks[i + 1]}; // of the pieces that are left, the nearest one last
        double from = breaks[i];
        while (!ends.empty()) {
            const double to = ends.back();
            const HermitePiece piece{from, to, quintic(curve(from), curve(to), to - from)};
            if (error_of(curve, piece) <= hermite_error_mm) {
                done.push_back(piece);
                ends.pop_back();
                from = to;
            } else {
                ends.push_back(0.5 * (from + to));
            }
            if (done.size() + ends.size() > most_pieces) { // also where the error is no number
                return {};
            }
        }
    }
    return done;
}

} // namespace splinefeed::host
