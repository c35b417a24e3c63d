// SPDX-License-Identifier: MIT
//
// Random element files: lines, arcs in any plane with any sweep, helices and spirals, Bezier segments and NURBS that
// meet.
#pragma once

#include "support/random_path.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace splinefeed_test {

class RandomElements {
public:
    using Vector = std::array<double, 3>;

    explicit RandomElements(std::uint64_t seed) : random_(seed) {}

    /// @param numbers  of a point, 3 to 6
    nlohmann::json document(int count, int numbers) {
        numbers_ = numbers;
        here_.assign(static_cast<std::size_t>(numbers), 0.0);
        scale_ = std::pow(10.0, random_.between(-1.0, 2.0));
        nlohmann::json out;
        out["elements"] = nlohmann::json::array();
        for (int i = 0; i < count; ++i) {
            out["elements"].push_back(element());
        }
        for (int i = random_.below(3); i > 0; --i) {
            out["events"].push_back({{"after_element", random_.below(count + 1)}, {"what", "stop"}});
            out["dwells"].push_back({{"after_element", random_.below(count + 1)}, {"seconds", 0.5}});
        }
        return out;
    }

    RandomPath& random() { return random_; }

private:
    Vector direction() {
        for (;;) {
            const Vector v{random_.between(-1, 1), random_.between(-1, 1), random_.between(-1, 1)};
            const double n = std::hypot(v[0], v[1], v[2]);
            if (n > 0.1 && n < 1.0) {
                return {v[0] / n, v[1] / n, v[2] / n};
            }
        }
    }

    static Vector cross(const Vector& a, const Vector& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    double length() { return scale_ * std::pow(10.0, random_.between(-2.0, 0.5)); }

    nlohmann::json element() {
        nlohmann::json e;
        e["from"] = here_;
        const std::vector<double> old = here_;
        for (std::size_t k = 3; k < here_.size(); ++k) {
            here_[k] += random_.below(3) == 0 ? random_.between(-1, 1) : 0.0;
        }
        const int kind = random_.below(12);
        if (kind < 6) {
            line();
        } else if (kind < 9) {
            arc(e, old);
        } else {
            spline(e, old, kind == 11);
        }
        e["to"] = here_;
        if (random_.below(5) == 0) {
            e["rapid"] = true;
        } else {
            e["feed_mm_s"] = random_.between(10, 200);
        }
        if (random_.below(3) == 0) {
            e["tolerance_mm"] = random_.below(4) == 0 ? 0.0 : std::pow(10.0, random_.between(-3, 0));
        }
        if (random_.below(10) == 0) {
            e["mode"] = random_.below(2) == 0 ? "exact_path" : "exact_stop";
        }
        return e;
    }

    void line() {
        const double l = length();
        const Vector way = direction();
        for (std::size_t k = 0; k < 3; ++k) {
            here_[k] += random_.below(20) == 0 ? 0.0 : l * way[k];
        }
    }

    void arc(nlohmann::json& e, const std::vector<double>& old) {
        const Vector axis = random_.below(2) == 0 ? Vector{0, 0, 1} : direction();
        Vector x = cross(axis, direction());
        const double n = std::hypot(x[0], x[1], x[2]);
        const double radius = length();
        const double end_radius = random_.below(4) == 0 ? radius * random_.between(0.8, 1.2) : radius;
        const double rise = random_.below(3) == 0 ? random_.between(-1, 1) * radius : 0.0;
        const double most = random_.below(6) == 0 ? 20.0 : 6.0;
        const double angle = random_.below(8) == 0 ? 2.0 * std::numbers::pi : random_.between(-most, most);
        for (double& part : x) {
            part /= n;
        }
        const Vector y = cross(axis, x);
        Vector centre{};
        for (std::size_t k = 0; k < 3; ++k) {
            centre[k] = old[k] - radius * x[k];
            here_[k] = centre[k] + end_radius * (std::cos(angle) * x[k] + std::sin(angle) * y[k]) + rise * axis[k];
        }
        e["type"] = "arc";
        e["centre"] = centre;
        e["axis"] = axis;
        e["angle"] = angle;
    }

    void spline(nlohmann::json& e, const std::vector<double>& old, bool nurbs) {
        const int degree = nurbs ? 2 + random_.below(4) : 1 + random_.below(5);
        const int count = degree + 1 + (nurbs ? random_.below(4) : 0);
        Vector point{old[0], old[1], old[2]};
        const double l = length();
        std::vector<double> weights;
        const bool rational = nurbs && random_.below(2) == 0;
        for (int i = 0; i < count; ++i) {
            e["control_points"].push_back(point);
            weights.push_back(rational ? random_.between(0.5, 2.0) : 1.0);
            const Vector way = direction();
            for (std::size_t k = 0; k < 3 && i + 1 < count; ++k) {
                point[k] += l * (way[k] + (k == 0 ? 1.0 : 0.0));
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            here_[k] = point[k];
        }
        e["type"] = nurbs ? "nurbs" : "bezier";
        if (nurbs) {
            std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
            for (int i = 1; i < count - degree; ++i) {
                knots.push_back(i);
            }
            knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, count - degree);
            e["knots"] = knots;
            e["weights"] = weights;
            e["order"] = degree + 1;
        }
    }

    RandomPath random_;
    std::vector<double> here_;
    int numbers_ = 3;
    double scale_ = 1.0;
};

} // namespace splinefeed_test
