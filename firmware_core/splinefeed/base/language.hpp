// SPDX-License-Identifier: MIT
// One error where the compiler is older than the code, in the place of thousands: no compiler goes on without an
// include.
#pragma once

#if __cplusplus < 202002L
#define SPLINEFEED_LANGUAGE "splinefeed needs C++20: compile with -std=c++20"
#include SPLINEFEED_LANGUAGE
#endif
