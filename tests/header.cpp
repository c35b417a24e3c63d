// SPDX-License-Identifier: MIT
// For the target whose precompiled headers the tests use.
#include "support/catch.hpp"
