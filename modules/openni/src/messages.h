// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the user reads when a camera does not work: what happened, and what to do about it.
#pragma once

#include <string>
#include <vector>

#include "foothold/openni/openni_source.h"
#include "usb.h"

namespace foothold::capture {

/// No camera was found at all.
std::string no_device_advice(const std::vector<UsbCamera>& on_usb);

/// The camera that was asked for is not among those found.
std::string unknown_device_message(const std::string& wanted, const std::vector<OpenNIDeviceInfo>& devices);

/// OpenNI2 itself would not start.
std::string no_driver_message(const std::string& openni_error);

/// A camera was found but would not open.
/// @param access  of its USB node; kAllowed for cameras that are not on the USB.
std::string cannot_open_message(const std::string& uri, const std::string& node, UsbAccess access, const std::string& openni_error);

/// A sensor does not offer the mode that was asked for.
std::string unknown_mode_message(const std::string& sensor, const OpenNIVideoMode& wanted, const std::vector<OpenNIVideoMode>& modes);

/// A camera without a depth sensor is of no use.
std::string no_depth_message(const std::string& uri);

/// A camera without a colour sensor is, with a warning.
std::string no_colour_message(const std::string& uri);

/// A call into a driver did not return in time.
std::string not_answering_message(const std::string& activity, int time_ms);

/// Streams are open but no pairs arrive.
std::string silence_message(bool depth_arrives, bool colour_arrives, int time_ms);

/// The camera has left the bus.
std::string unplugged_message(const std::string& uri);

/// An .oni recording that does not play.
std::string recording_message(const std::string& file, const std::string& what);

/// A mode in words, such as "640x480 at 30 Hz (depth 1 mm)".
std::string describe_mode(const OpenNIVideoMode& mode);

}  // namespace foothold::capture
