// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "messages.h"

#include "foothold/base/number_text.h"

namespace foothold::capture {
namespace {

constexpr const char* kSeeDocs = "See docs/cameras.md.";

std::string seconds(int time_ms) { return fixed_text(0.001 * time_ms, 1) + " s"; }

std::string in_brackets(const std::string& text) { return text.empty() ? std::string() : " (OpenNI2 says: " + text + ")"; }

std::string list_devices(const std::vector<OpenNIDeviceInfo>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    text += (i == 0 ? "" : "; ") + std::to_string(i) + ": " + devices[i].uri + " (" + devices[i].vendor + " " + devices[i].name + ")";
  }
  return text;
}

}  // namespace

std::string no_device_advice(const std::vector<UsbCamera>& on_usb) {
  std::string text = "no camera found. ";
  if (on_usb.empty()) {
    return text +
           "No depth camera is on the USB either: check the cable and that `lsusb` lists the camera (1d27:... for PrimeSense, Xtion and "
           "Structure); "
           "cameras without their own power supply may need a port of the computer itself. In a container, pass /dev/bus/usb on. Without a "
           "camera, "
           "use the virtual one. " +
           kSeeDocs;
  }
  for (const UsbCamera& camera : on_usb) {
    text += "The USB has a " + camera.describe() + ", ";
    switch (camera.support) {
      case UsbCamera::Support::kPrimeSense:
        switch (usb_access(usb_node(camera.bus, camera.address))) {
          case UsbAccess::kDenied:
            text += "but you may not use it: install libopenni2-0, whose udev rules allow it, and plug the camera in again. ";
            break;
          case UsbAccess::kNoNode:
            text += "but its device node " + usb_node(camera.bus, camera.address) + " is missing: in a container, pass /dev/bus/usb on. ";
            break;
          case UsbAccess::kAllowed:
            text += "but OpenNI2's PS1080 driver did not take it: reinstall libopenni2-0 and plug the camera in again. ";
            break;
        }
        break;
      case UsbCamera::Support::kKinect1:
        text += "which needs libfreenect's OpenNI2 driver; Debian does not package it, docs/cameras.md says how to build it. ";
        break;
      case UsbCamera::Support::kNone:
        text += "which OpenNI2 on Debian has no driver for. ";
        break;
    }
  }
  return text + kSeeDocs;
}

std::string unknown_device_message(const std::string& wanted, const std::vector<OpenNIDeviceInfo>& devices) {
  return "device '" + wanted + "': no such camera. Found: " + list_devices(devices) +
         ". Give an index or a URI of these, or nothing for the first.";
}

std::string no_driver_message(const std::string& openni_error) {
  return "OpenNI2 found no usable driver" + in_brackets(openni_error) +
         ". Drivers are files lib*.so.0 in the folder OpenNI2/Drivers beside libOpenNI2.so.0: reinstall libopenni2-0, and check "
         "LD_LIBRARY_PATH if it "
         "selects another copy of the library. " +
         kSeeDocs;
}

std::string cannot_open_message(const std::string& uri, const std::string& node, UsbAccess access, const std::string& openni_error) {
  const std::string start = "camera '" + uri + "' cannot be opened" + in_brackets(openni_error) + ". ";
  switch (access) {
    case UsbAccess::kDenied:
      return start + "You may not write to " + node +
             ": install libopenni2-0, whose udev rules allow it, run `sudo udevadm control --reload` and plug the camera in again. " +
             kSeeDocs;
    case UsbAccess::kNoNode:
      return start + "Its device node " + node +
             " does not exist: the camera was unplugged, or this is a container without /dev/bus/usb. " + kSeeDocs;
    case UsbAccess::kAllowed:
      break;
  }
  return start + "Most likely another program is using it: close that program" +
         (node.empty() ? "" : " (`sudo fuser -v " + node + "` names it)") + ", or unplug the camera and plug it in again. " + kSeeDocs;
}

std::string describe_mode(const OpenNIVideoMode& mode) {
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + " at " + std::to_string(mode.fps) + " Hz (" + mode.format + ")";
}

std::string unknown_mode_message(const std::string& sensor, const OpenNIVideoMode& wanted, const std::vector<OpenNIVideoMode>& modes) {
  std::string text = "the camera has no " + sensor + " mode of " + std::to_string(wanted.width) + "x" + std::to_string(wanted.height) +
                     " at " + std::to_string(wanted.fps) + " Hz that Foothold can read. It offers: ";
  for (std::size_t i = 0; i < modes.size(); ++i) text += (i == 0 ? "" : ", ") + describe_mode(modes[i]);
  return text +
         ". Choose a size and fps that the sensor offers; colour may have a size of its own. Depth must come in 1 mm or 0.1 mm, colour in "
         "RGB.";
}

std::string no_depth_message(const std::string& uri) {
  return "camera '" + uri + "' has no depth sensor. Choose another camera. " + kSeeDocs;
}

std::string no_colour_message(const std::string& uri) {
  return "camera '" + uri + "' has no colour sensor: its frames are grey, and finding the camera again rests on depth alone";
}

std::string not_answering_message(const std::string& activity, int time_ms) {
  return "the camera's driver has not answered for " + seconds(time_ms) + " while " + activity +
         ". Unplug the camera, wait a moment, plug it in again, and restart the program if that does not help. " + kSeeDocs;
}

std::string silence_message(bool depth_arrives, bool colour_arrives, int time_ms) {
  const std::string since = " for " + seconds(time_ms);
  if (colour_arrives && !depth_arrives) {
    return "the camera sends colour but no depth" + since +
           ": its projector or depth sensor has failed, is too hot, or lacks power. Use a port of the computer itself, let the camera cool "
           "down, and "
           "check that no other program uses its depth. " +
           kSeeDocs;
  }
  if (depth_arrives && !colour_arrives) {
    return "the camera sends depth but no colour" + since + ": use a port with more bandwidth, or a smaller mode. " + kSeeDocs;
  }
  if (depth_arrives && colour_arrives) {
    return "the camera's depth and colour never belong to the same moment" + since + ": raise pair_tolerance_ms or use a smaller mode. " +
           kSeeDocs;
  }
  return "the camera has sent nothing" + since +
         "; it is being opened anew. If that does not help: plug it into a port of the computer itself, without other cameras on the same "
         "hub; some "
         "cameras do not work on USB 3 ports before UsbInterface=2 is set in PS1080.ini. " +
         kSeeDocs;
}

std::string unplugged_message(const std::string& uri) { return "camera '" + uri + "' was unplugged; waiting until it is plugged in again"; }

std::string recording_message(const std::string& file, const std::string& what) {
  return "recording '" + file + "': " + what +
         ". Debian's OpenNI2 does not play .oni files reliably. Record with --record DIR instead and play the folder with "
         "replay_sequence. " +
         kSeeDocs;
}

}  // namespace foothold::capture
