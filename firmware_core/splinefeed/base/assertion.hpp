// SPDX-License-Identifier: MIT
//
// The one assertion macro of the core. A broken precondition stops a debug build on the spot; a release build
// compiles the check away, and every function that asserts also says what it returns in that case.
#pragma once

#ifndef SPLINEFEED_ASSERT
#ifdef NDEBUG
/// Nothing is evaluated; sizeof keeps the operands "used", so that a variable that is only checked does not warn.
#define SPLINEFEED_ASSERT(cond) static_cast<void>(sizeof((cond) ? 1 : 0))
#else
/// A trap instead of a message: the core has no output channel. Inside a constant expression it fails to compile.
#define SPLINEFEED_ASSERT(cond) ((cond) ? static_cast<void>(0) : __builtin_trap())
#endif
#endif
