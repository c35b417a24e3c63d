// SPDX-License-Identifier: MIT
// Arm semihosting: how a program without an operating system speaks to the emulator or debugger that runs it.
#pragma once

[[noreturn]] void exit_program(int status);
