// SPDX-License-Identifier: MIT
//
// The only assertion macro of the core. A debug build stops at a broken precondition. A release build compiles the
// check away; every function that asserts also documents what it returns in that case.
#pragma once

#include "splinefeed/base/language.hpp"

#ifndef SPLINEFEED_ASSERT
#ifdef NDEBUG
/// Evaluates nothing. sizeof keeps the operands "used": a variable that is only used in a check causes no warning.
#define SPLINEFEED_ASSERT(cond) static_cast<void>(sizeof((cond) ? 1 : 0))
#else
/// A trap instead of a message, because the core has no output channel. In a constant expression a failed check is an
/// error of the compiler.
#define SPLINEFEED_ASSERT(cond) ((cond) ? static_cast<void>(0) : __builtin_trap())
#endif
#endif
