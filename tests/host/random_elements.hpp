// SPDX-License-Identifier: MIT
//
// Random element files: lines of all lengths and turns, arcs in any plane with any sweep, helices and spirals, Bezier
// segments and NURBS, runs of short lines along curves with rounded ends; all that meet.
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
        nlohmann::json& elements = out["elements"];
        for (int i = 0; i < count; ++i) {
            if (random_.below(12) == 0) {
                short_lines(elements);
            } else {
                elements.push_back(element());
            }
        }
        count = static_cast<int>(elements.size());
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

    static Vector vector_product(const Vector& a, const Vector& b) {
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
            e["chain_tolerance_mm"] = random_.below(4) == 0 ? 0.0 : std::pow(10.0, random_.between(-4, 0));
        }
        if (random_.below(10) == 0) {
            e["mode"] = random_.below(2) == 0 ? "exact_path" : "exact_stop";
        }
        return e;
    }

    // Any direction, or about the one before: on, back, or a little beside.
    void line() {
        const double l = random_.below(10) == 0 ? scale_ * std::pow(10.0, random_.between(-6.0, 0.0)) : length();
        Vector way = direction();
        if (random_.below(4) == 0) {
            const double beside = random_.below(3) == 0 ? 0.0 : std::pow(10.0, random_.between(-6.0, -1.0));
            const double sense = random_.below(3) == 0 ? -1.0 : 1.0;
            for (std::size_t k = 0; k < 3; ++k) {
                way[k] = sense * last_way_[k] + beside * way[k];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            here_[k] += random_.below(40) == 0 ? 0.0 : l * way[k];
        }
        last_way_ = way;
    }

    // As a CAM program has them: chords of a helix about any axis, rounded to a grid.
    void short_lines(nlohmann::json& out) {
        const Vector axis = direction();
        Vector x = vector_product(axis, direction());
        const double n = std::hypot(x[0], x[1], x[2]);
        const double radius = length();
        const double rise = random_.between(-1, 1) * radius;
        const double step = std::pow(10.0, random_.between(-2.5, -0.3));
        const double uneven = random_.below(2) == 0 ? 0.0 : 0.8;
        const double grid = random_.below(3) == 0 ? 1e-9 : std::pow(10.0, -random_.between(2.0, 4.0));
        const double tolerance = std::pow(10.0, random_.between(-3.0, -0.5));
        const double feed = random_.between(10, 200);
        for (double& part : x) {
            part /= n;
        }
        const Vector y = vector_product(axis, x);
        const std::vector<double> start = here_;
        double angle = 0.0;
        for (int i = 5 + random_.below(120); i > 0; --i) {
            nlohmann::json e{{"from", here_}, {"tolerance_mm", tolerance}, {"feed_mm_s", feed}};
            angle += step * random_.between(1.0 - uneven, 1.0 + uneven);
            for (std::size_t k = 0; k < 3; ++k) {
                const double place = start[k] + radius * ((std::cos(angle) - 1.0) * x[k] + std::sin(angle) * y[k]) +
                                     0.16 * angle * rise * axis[k];
                here_[k] = std::round(place / grid) * grid;
            }
            e["to"] = here_;
            out.push_back(e);
        }
    }

    void arc(nlohmann::json& e, const std::vector<double>& old) {
        const Vector axis = random_.below(2) == 0 ? Vector{0, 0, 1} : direction();
        Vector x = vector_product(axis, direction());
        const double n = std::hypot(x[0], x[1], x[2]);
        const double radius = length();
        const double end_radius = random_.below(4) == 0 ? radius * random_.between(0.8, 1.2) : radius;
        const double rise = random_.below(3) == 0 ? random_.between(-1, 1) * radius : 0.0;
        const double most = random_.below(6) == 0 ? 20.0 : 6.0;
        const double angle = random_.below(8) == 0 ? 2.0 * std::numbers::pi : random_.between(-most, most);
        for (double& part : x) {
            part /= n;
        }
        const Vector y = vector_product(axis, x);
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
    Vector last_way_{1.0, 0.0, 0.0};
    double scale_ = 1.0;
};

} // namespace splinefeed_test
