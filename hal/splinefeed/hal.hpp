// SPDX-License-Identifier: MIT
// All ports that are linked. Each port library of splinefeed::hal defines a macro that enables its headers here.
#pragma once

#include "splinefeed/base/language.hpp"

#include "splinefeed/hal/motion_port.hpp"
#include "splinefeed/hal/stop_sequence.hpp"

#ifdef SPLINEFEED_HAS_MODBUS // splinefeed::hal_modbus
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"
#endif

#ifdef SPLINEFEED_HAS_GPIO // splinefeed::hal_gpio
#include "splinefeed/hal/gpio/gpio_port.hpp"
#include "splinefeed/hal/gpio/input_pins.hpp"
#include "splinefeed/hal/gpio/input_watch.hpp"
#include "splinefeed/hal/gpio/output_pins.hpp"
#include "splinefeed/hal/gpio/step_port.hpp"
#endif
