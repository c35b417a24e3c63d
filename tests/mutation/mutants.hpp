// SPDX-License-Identifier: MIT
// What tests/mutation/schemata.py puts into sources, so that one build holds all mutants: SPLINEFEED_MUTANT is the
// number of the one that acts, and a file named by SPLINEFEED_MUTANTS_REACHED gets the numbers of all that were passed.
// Constant expressions are left as they are.
//
// An operator `a < b` becomes `a < Less{7} < b`: of equal precedence and from left to right, so no operand has to be
// found.
#pragma once

#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wnarrowing"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wsign-compare"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace mutation {

inline std::array<bool, 4096> reached{};

struct Choice {
    int id = -1;
    Choice() {
        if (const char* const set = std::getenv("SPLINEFEED_MUTANT")) {
            id = std::atoi(set);
        }
    }
    ~Choice() {
        const char* const name = std::getenv("SPLINEFEED_MUTANTS_REACHED");
        std::FILE* const file = name == nullptr ? nullptr : std::fopen(name, "a");
        for (std::size_t i = 0; file != nullptr && i < reached.size(); ++i) {
            if (reached[i]) {
                std::fprintf(file, "%zu\n", i);
            }
        }
        if (file != nullptr) {
            std::fclose(file);
        }
    }
};

inline const Choice choice;

constexpr bool acts(int id) {
    if (std::is_constant_evaluated()) {
        return false;
    }
    reached[static_cast<std::size_t>(id)] = true;
    return choice.id == id;
}

/// A number: one more, or twice a fraction.
template <typename T>
constexpr T number(int id, T value) {
    return !acts(id) ? value : std::is_integral_v<T> ? value + 1 : value == 0 ? T(1) : value * 2;
}

template <typename T>
constexpr const T& least(int id, const T& a, const T& b) {
    return acts(id) == (b < a) ? a : b;
}

template <typename T>
constexpr const T& most(int id, const T& a, const T& b) {
    return acts(id) == (a < b) ? a : b;
}

// A comparison is turned round. A bound that moves by one is mostly no mutant: of real numbers equal ones are too rare,
// and what a search does with equal ones does not matter.
#define MUTATION_COMPARISON(Name, op, turned)                                                                          \
    struct Name {                                                                                                      \
        int id;                                                                                                        \
    };                                                                                                                 \
    template <typename A>                                                                                              \
    struct Name##Left {                                                                                                \
        const A& a;                                                                                                    \
        int id;                                                                                                        \
    };                                                                                                                 \
    template <typename A>                                                                                              \
    constexpr Name##Left<A> operator op(const A& a, Name m) {                                                          \
        return {a, m.id};                                                                                              \
    }                                                                                                                  \
    template <typename A, typename B>                                                                                  \
    constexpr bool operator op(Name##Left<A> left, const B& b) {                                                       \
        return acts(left.id) ? left.a turned b : left.a op b;                                                          \
    }

MUTATION_COMPARISON(Less, <, >=)
MUTATION_COMPARISON(LessEqual, <=, >)
MUTATION_COMPARISON(Greater, >, <=)
MUTATION_COMPARISON(GreaterEqual, >=, <)
MUTATION_COMPARISON(Equal, ==, !=)
MUTATION_COMPARISON(Unequal, !=, ==)

// Where the types do not have the other operator the result is the left operand, or nothing.
#define MUTATION_ARITHMETIC(Name, op, other)                                                                           \
    struct Name {                                                                                                      \
        int id;                                                                                                        \
    };                                                                                                                 \
    template <typename A>                                                                                              \
    struct Name##Left {                                                                                                \
        const A& a;                                                                                                    \
        int id;                                                                                                        \
    };                                                                                                                 \
    template <typename A>                                                                                              \
    constexpr Name##Left<A> operator op(const A& a, Name m) {                                                          \
        return {a, m.id};                                                                                              \
    }                                                                                                                  \
    template <typename A, typename B>                                                                                  \
    constexpr auto operator op(Name##Left<A> left, const B& b) {                                                       \
        using Result = std::remove_cvref_t<decltype(left.a op b)>;                                                     \
        if (!acts(left.id)) {                                                                                          \
            return static_cast<Result>(left.a op b);                                                                   \
        }                                                                                                              \
        if constexpr (requires { static_cast<Result>(left.a other b); }) {                                             \
            return static_cast<Result>(left.a other b);                                                                \
        } else if constexpr (requires { static_cast<Result>(left.a); }) {                                              \
            return static_cast<Result>(left.a);                                                                        \
        } else {                                                                                                       \
            return Result{};                                                                                           \
        }                                                                                                              \
    }

MUTATION_ARITHMETIC(Plus, +, -)
MUTATION_ARITHMETIC(Minus, -, +)
MUTATION_ARITHMETIC(Times, *, /)
MUTATION_ARITHMETIC(Over, /, *)

} // namespace mutation
