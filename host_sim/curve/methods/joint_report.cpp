// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/joint_report.hpp"

#include "splinefeed/splines/beta_joint.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

using AxisVector = PerAxis<double>;

constexpr double least_regular = 1e-13; // a derivative of less, relative to the control points, is none

AxisVector minus(const AxisVector& a, const AxisVector& b) {
    AxisVector out{};
    for (std::size_t k = 0; k < out.size(); ++k) {
        out[k] = a[k] - b[k];
    }
    return out;
}

AxisVector multiple(double factor, AxisVector a) {
    for (double& x : a) {
        x *= factor;
    }
    return a;
}

double inner_product(const AxisVector& a, const AxisVector& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}

double size(const AxisVector& a) {
    return std::sqrt(inner_product(a, a));
}

// The largest |coordinate|: what rounding of a control point is relative to.
double piece_size(const BezierPiece<double>& piece) {
    double most = 0.0;
    for (int i = 0; i <= piece.degree; ++i) {
        for (const double x : piece.point(i)) {
            most = std::max(most, std::fabs(x));
        }
    }
    return most;
}

const char* class_of(bool c1, bool c2, bool regular, bool g1, bool g2, bool abs_kappa) {
    if (!regular) {
        return c2 ? "C2+singular" : c1 ? "C1+singular" : "C0+singular";
    }
    if (c2) {
        return "C2";
    }
    if (g2) {
        return c1 ? "C1+G2" : "G2";
    }
    if (abs_kappa) {
        return c1 ? "C1+|k|" : "G1+|k|";
    }
    return c1 ? "C1" : g1 ? "G1" : "C0";
}

double length_of(const DescribedCurve& curve, std::size_t piece) {
    return curve.intervals.empty() ? 1.0 : curve.intervals[piece].to - curve.intervals[piece].from;
}

/// Of the position and the first two derivatives of a piece by its parameter: a small piece is not blurred by a large
/// neighbour.
struct Rounding {
    double position;
    double first;
    double second;
};

Rounding rounding_of(const BezierPiece<double>& piece, const Agreement& agreement) {
    const double e = agreement.rounding * piece_size(piece);
    return {e, 2.0 * piece.degree * e, 4.0 * piece.degree * std::max(piece.degree - 1, 1) * e};
}

/// Whether two values agree: relative to the larger one, and beyond the noise.
bool agree(const Agreement& agreement, double jump, double a, double b, double noise) {
    return jump <= agreement.relative * std::max(a, b) + noise;
}

/// Direction and curvature at a joint where both sides have them.
struct Geometry {
    bool g1 = false;
    bool g2 = false;
    bool abs_kappa = false;
    double ratio = 0.0; ///< of the first derivatives
    double curvature_jump = 0.0;
    double modulus_jump = 0.0;
};

/// @param c0  whether the points meet
Geometry geometry_of(const CurveSample& end, const CurveSample& start, const Rounding& e0, const Rounding& e1, bool c0,
                     const Agreement& agreement) {
    const double n0 = size(end.first);
    const double n1 = size(start.first);
    const double k0 = size(end.curvature);
    const double k1 = size(start.curvature);
    const double noise =
        e0.second / (n0 * n0) + e1.second / (n1 * n1) + 3.0 * (e0.first * k0 / n0 + e1.first * k1 / n1);
    const AxisVector turn = minus(multiple(1.0 / n1, start.first), multiple(1.0 / n0, end.first));
    Geometry out;
    out.ratio = n1 / n0;
    out.curvature_jump = size(minus(start.curvature, end.curvature));
    out.modulus_jump = std::fabs(k1 - k0);
    out.g1 = c0 && size(turn) <= agreement.relative + e0.first / n0 + e1.first / n1;
    out.g2 = out.g1 && agree(agreement, out.curvature_jump, k0, k1, noise);
    out.abs_kappa = c0 && agree(agreement, out.modulus_jump, k0, k1, noise);
    return out;
}

nlohmann::ordered_json joint_of(const DescribedCurve& curve, const Agreement& agreement, std::size_t from,
                                std::size_t to) {
    const BezierPiece<double>& before = curve.pieces[from];
    const BezierPiece<double>& after = curve.pieces[to];
    const CurveSample end = sample_of(before, curve.axes, 1.0);
    const CurveSample start = sample_of(after, curve.axes, 0.0);
    const Rounding e0 = rounding_of(before, agreement);
    const Rounding e1 = rounding_of(after, agreement);
    const double h0 = length_of(curve, from);
    const double h1 = length_of(curve, to);
    const AxisVector q1 = multiple(1.0 / h0, end.first);
    const AxisVector r1 = multiple(1.0 / h1, start.first);
    const AxisVector q2 = multiple(1.0 / (h0 * h0), end.second);
    const AxisVector r2 = multiple(1.0 / (h1 * h1), start.second);
    const double d1_jump = size(minus(r1, q1));
    const double d2_jump = size(minus(r2, q2));
    const bool c0 = size(minus(start.point, end.point)) <= 10.0 * std::max(e0.position, e1.position);
    const bool c1 = c0 && agree(agreement, d1_jump, size(q1), size(r1), e0.first / h0 + e1.first / h1);
    const bool c2 = c1 && agree(agreement, d2_jump, size(q2), size(r2), e0.second / (h0 * h0) + e1.second / (h1 * h1));
    const bool regular = end.regular && start.regular && size(end.first) > e0.first && size(start.first) > e1.first;
    const Geometry geometry = regular ? geometry_of(end, start, e0, e1, c0, agreement) : Geometry{};
    const auto defined = [regular](auto value) {
        return regular ? nlohmann::ordered_json(value) : nullptr;
    };
    const auto& [g1, g2, abs_kappa, ratio, curvature_jump, modulus_jump] = geometry;
    nlohmann::ordered_json joint{{"from", from},
                                 {"to", to},
                                 {"class", class_of(c1, c2, regular, g1, g2, g1 && abs_kappa)},
                                 {"C0", c0},
                                 {"C1", c1},
                                 {"C2", c2},
                                 {"regular", regular},
                                 {"G1", defined(g1)},
                                 {"G2", defined(g2)},
                                 {"abs_kappa", defined(abs_kappa)},
                                 {"length_ratio_d1", defined(ratio)},
                                 {"d1_jump", d1_jump},
                                 {"d2_jump", d2_jump},
                                 {"K_jump", defined(curvature_jump)},
                                 {"abs_kappa_jump", defined(modulus_jump)}};
    const Result<BetaMeasure<double>> measured = g1 ? measure_joint(before, after) : Error::tangent_vanishes;
    joint["beta1"] = measured.has_value() ? nlohmann::ordered_json(measured->beta.beta1) : nullptr;
    joint["beta2"] = measured.has_value() ? nlohmann::ordered_json(measured->beta.beta2) : nullptr;
    return joint;
}

} // namespace

CurveSample sample_of(const BezierPiece<double>& piece, int axes, double u) {
    const auto n = static_cast<unsigned>(piece.degree);
    CurveSample out;
    double largest = 0.0;
    for (const unsigned k : indices(axes)) {
        PerDegree<double> row = piece.control[k];
        for (unsigned i = 0; i <= n; ++i) {
            largest = std::max(largest, std::fabs(row[i]));
        }
        for (unsigned step = 1; step <= n; ++step) {
            if (step + 1 == n) {
                out.second[k] = n * (n - 1) * (row[2] - row[1] - (row[1] - row[0]));
            }
            if (step == n) {
                out.first[k] = n * (row[1] - row[0]);
            }
            for (unsigned i = 0; i + step <= n; ++i) {
                row[i] += u * (row[i + 1] - row[i]);
            }
        }
        out.point[k] = u == 1.0 ? piece.control[k][n] : row[0];
    }
    const double n_sq = inner_product(out.first, out.first);
    out.regular = std::sqrt(n_sq) > 2.0 * n * least_regular * largest;
    if (out.regular) {
        const AxisVector normal = minus(out.second, multiple(inner_product(out.first, out.second) / n_sq, out.first));
        out.curvature = multiple(1.0 / n_sq, normal);
        out.kappa = axes == 2 ? (out.first[0] * out.second[1] - out.first[1] * out.second[0]) / (n_sq * std::sqrt(n_sq))
                              : size(out.curvature);
    }
    return out;
}

nlohmann::ordered_json joint_report(const DescribedCurve& curve, const Agreement& agreement) {
    nlohmann::ordered_json joints = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i + 1 < curve.pieces.size(); ++i) {
        joints.push_back(joint_of(curve, agreement, i, i + 1));
    }
    if (curve.closed && !curve.pieces.empty()) {
        joints.push_back(joint_of(curve, agreement, curve.pieces.size() - 1, 0));
    }
    return joints;
}

nlohmann::ordered_json sample_report(const BezierPiece<double>& piece, int axes) {
    nlohmann::ordered_json samples = nlohmann::ordered_json::array();
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const CurveSample sample = sample_of(piece, axes, u);
        nlohmann::ordered_json row;
        row["u"] = u;
        row["p"] = to_json(sample.point, axes);
        row["d1"] = to_json(sample.first, axes);
        row["d2"] = to_json(sample.second, axes);
        row["kappa"] = sample.regular ? nlohmann::ordered_json(sample.kappa) : nullptr;
        row["K"] = sample.regular ? to_json(sample.curvature, axes) : nullptr;
        samples.push_back(row);
    }
    return samples;
}

} // namespace splinefeed::host
