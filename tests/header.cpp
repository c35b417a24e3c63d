// SPDX-License-Identifier: MIT
// For the target whose precompiled header the tests use.
#include "support/catch.hpp"
