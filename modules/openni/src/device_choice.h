// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Which camera to open.
#pragma once

#include <string>
#include <vector>

#include "foothold/openni/openni_source.h"

namespace foothold::capture {

/// True if a device is the path of an .oni recording.
bool is_recording(const std::string& device);

/// The URI of the camera that a user asks for: see OpenNISettings::device.
/// @throws DeviceError if there is no camera or not this one; FileError if a recording does not exist.
std::string choose_device(const std::string& wanted, const std::vector<OpenNIDeviceInfo>& devices);

/// The URI under which a lost camera is back; empty if it is not.
///
/// With PrimeSense's driver a camera gets a new URI whenever it is plugged in. Another camera of the same model counts only if it has just
/// been plugged in, since one that was there before may be somebody else's.
///
/// @param newcomers  URIs of cameras that were plugged in since.
/// @param any_model  True if the user named no camera: then any newcomer will do, though one of the same model is preferred.
std::string find_again(const OpenNIDeviceInfo& lost, const std::vector<OpenNIDeviceInfo>& devices,
                       const std::vector<std::string>& newcomers, bool any_model);

}  // namespace foothold::capture
