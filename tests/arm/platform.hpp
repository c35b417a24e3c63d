// SPDX-License-Identifier: MIT
// What the proof program needs from its surroundings: a way to say something.
#pragma once

void write_text(const char* text);
