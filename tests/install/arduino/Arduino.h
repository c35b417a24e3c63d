// SPDX-License-Identifier: MIT
// What a sketch finds in Arduino.h, as far as the test needs it, and the macros of Arduino's own that a library has to
// live with.
#pragma once

#include <cstdint>

#define LOW 0x0
#define HIGH 0x1
#define INPUT 0x0
#define OUTPUT 0x1
#define CHANGE 2
#define FALLING 3
#define RISING 4
#define PI 3.1415926535897932384626433832795
#define HALF_PI 1.5707963267948966192313216916398
#define TWO_PI 6.283185307179586476925286766559
#define DEG_TO_RAD 0.017453292519943295769236907684886
#define EULER 2.718281828459045235360287471352
#define SERIAL 0x0
#define DISPLAY 0x1
#define DEFAULT 0
#define abs(x) ((x) > 0 ? (x) : -(x))
#define constrain(amt, low, high) ((amt) < (low) ? (low) : ((amt) > (high) ? (high) : (amt)))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define radians(deg) ((deg)*DEG_TO_RAD)
#define sq(x) ((x) * (x))
#define interrupts()
#define noInterrupts()
#define lowByte(w) ((uint8_t)((w)&0xff))
#define bitRead(value, bit) (((value) >> (bit)) & 0x01)
#define bit(b) (1UL << (b))
#define F(text) text

using byte = std::uint8_t;

void pinMode(int pin, int mode);
void digitalWrite(int pin, int level);
std::uint32_t micros();
void setup();
void loop();
