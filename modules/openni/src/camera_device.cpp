// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "camera_device.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "device_choice.h"
#include "messages.h"
#include "registration.h"
#include "runtime.h"
#include "usb.h"

namespace foothold::capture {
namespace {

constexpr Rgb8 kGrey{128, 128, 128};  ///< what cameras without a colour sensor see

/// The pinhole camera with a field of view, its principal point in the middle of the image.
Intrinsics intrinsics_from_field_of_view(const openni::VideoStream& stream, const ModeSize& size, const std::string& sensor) {
  const float horizontal_rad = stream.getHorizontalFieldOfView();
  const float vertical_rad = stream.getVerticalFieldOfView();
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  const Intrinsics intrinsics{0.5F * width / std::tan(0.5F * horizontal_rad), 0.5F * height / std::tan(0.5F * vertical_rad),
                              0.5F * (width - 1.0F), 0.5F * (height - 1.0F)};
  if (!is_valid(intrinsics))
    throw DeviceError("the camera does not report the field of view of its " + sensor + " sensor; give a calibration file");
  return intrinsics;
}

/// Copies an image row by row, undoing the mirror if need be.
template <class From, class To, class Convert>
void copy_image(const openni::VideoFrameRef& from, bool mirrored, Image<To>& to, Convert convert) {
  const int width = from.getWidth();
  const int height = from.getHeight();
  if (to.width() != width || to.height() != height) to = Image<To>(width, height);
  for (int v = 0; v < height; ++v) {
    const auto* row = reinterpret_cast<const From*>(static_cast<const std::uint8_t*>(from.getData()) +
                                                    static_cast<std::ptrdiff_t>(v) * from.getStrideInBytes());
    To* target = to.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    for (int u = 0; u < width; ++u) target[u] = convert(row[mirrored ? width - 1 - u : u]);
  }
}

template <class Pixel>
bool holds(const openni::VideoFrameRef& image, const ModeSize& size) {
  return image.getWidth() == size.width && image.getHeight() == size.height && image.getData() != nullptr &&
         image.getStrideInBytes() >= size.width * static_cast<int>(sizeof(Pixel)) &&
         image.getDataSize() >= (size.height - 1) * image.getStrideInBytes() + size.width * static_cast<int>(sizeof(Pixel));
}

ModeSize colour_size(const OpenNISettings& settings) {
  return settings.colour_width > 0 ? ModeSize{settings.colour_width, settings.colour_height} : ModeSize{settings.width, settings.height};
}

}  // namespace

CameraDevice::CameraDevice(const std::string& uri, const Options& options)
    : options_(options),
      depth_size_{options.settings.width, options.settings.height},
      colour_size_(colour_size(options.settings)),
      depth_listener_(depth_arrived_, options.wake),
      colour_listener_(colour_arrived_, options.wake) {
  open(uri);
  try {
    create_stream(depth_, openni::SENSOR_DEPTH, {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM});
    if (device_.hasSensor(openni::SENSOR_COLOR)) {
      create_stream(colour_, openni::SENSOR_COLOR, {openni::PIXEL_FORMAT_RGB888});
    } else {
      options_.warn(no_colour_message(uri));
      sensor_calibration_.colour = sensor_calibration_.depth;
    }
    register_images();
    start();
  } catch (...) {
    close();
    throw;
  }
}

CameraDevice::~CameraDevice() { close(); }

void CameraDevice::open(const std::string& uri) {
  options_.is_doing("opening '" + uri + "'");
  if (device_.open(uri.c_str()) != openni::STATUS_OK) {
    const std::string error = openni_error();
    if (is_recording(uri)) throw FileError(recording_message(uri, "OpenNI2 cannot open it (it says: " + error + ")"));
    int bus = 0;
    int address = 0;
    const std::string node = parse_usb_uri(uri, bus, address) ? usb_node(bus, address) : std::string();
    throw DeviceError(cannot_open_message(uri, node, node.empty() ? UsbAccess::kAllowed : usb_access(node), error));
  }
  options_.is_doing("asking '" + uri + "' for its modes");
  info_ = to_info(device_.getDeviceInfo());
  info_.depth_modes = video_modes(device_, openni::SENSOR_DEPTH);
  info_.colour_modes = video_modes(device_, openni::SENSOR_COLOR);
}

void CameraDevice::create_stream(openni::VideoStream& stream, openni::SensorType sensor, const std::vector<openni::PixelFormat>& formats) {
  const bool is_depth = sensor == openni::SENSOR_DEPTH;
  const std::string name = is_depth ? "depth" : "colour";
  options_.is_doing("setting up the " + name + " stream");
  const ModeSize& size = is_depth ? depth_size_ : colour_size_;
  const int fps = options_.settings.fps;
  const openni::SensorInfo* sensor_info = device_.getSensorInfo(sensor);
  if (sensor_info == nullptr) throw DeviceError(no_depth_message(info_.uri));

  const openni::Array<openni::VideoMode>& modes = sensor_info->getSupportedVideoModes();
  const openni::VideoMode* chosen = nullptr;
  for (const openni::PixelFormat format : formats) {
    for (int i = 0; i < modes.getSize() && chosen == nullptr; ++i) {
      const bool fits = modes[i].getResolutionX() == size.width && modes[i].getResolutionY() == size.height && modes[i].getFps() == fps;
      if (fits && modes[i].getPixelFormat() == format) chosen = &modes[i];
    }
  }
  if (chosen == nullptr)
    throw InvalidSettings(
        unknown_mode_message(name, {size.width, size.height, fps, {}}, is_depth ? info_.depth_modes : info_.colour_modes));

  // A recording has one mode, and setting even that one fails.
  if (stream.create(device_, sensor) != openni::STATUS_OK ||
      (!is_recording(info_.uri) && stream.setVideoMode(*chosen) != openni::STATUS_OK)) {
    throw DeviceError("camera '" + info_.uri + "': its " + name + " stream cannot be set up (OpenNI2 says: " + openni_error() +
                      "). Unplug the camera and plug it in again.");
  }
  stream.setMirroringEnabled(false);
  (is_depth ? depth_mirrored_ : colour_mirrored_) = stream.getMirroringEnabled();
  (is_depth ? sensor_calibration_.depth : sensor_calibration_.colour) =
      options_.calibration.has_value() ? (is_depth ? options_.calibration->depth : options_.calibration->colour)
                                       : intrinsics_from_field_of_view(stream, size, name);
}

Intrinsics CameraDevice::colour_camera_of_depth() const {
  const Intrinsics& colour = sensor_calibration_.colour;
  if (depth_size_.width == colour_size_.width) return colour;
  return colour.scaled(static_cast<float>(depth_size_.width) / static_cast<float>(colour_size_.width));
}

void CameraDevice::register_images() {
  options_.is_doing("switching registration");
  const std::string& wanted = options_.settings.registration;
  calibration_ = sensor_calibration_;
  if (!has_colour()) return;
  if (options_.calibration.has_value()) sensor_calibration_.depth_from_colour = options_.calibration->depth_from_colour;
  if (wanted == "auto" || wanted == "device") {
    const auto mode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    const bool same_view = depth_size_.width * colour_size_.height == depth_size_.height * colour_size_.width;
    by_device_ = same_view && device_.isImageRegistrationModeSupported(mode) && device_.setImageRegistrationMode(mode) == openni::STATUS_OK;
    if (!by_device_ && wanted == "device") {
      throw DeviceError("camera '" + info_.uri + "' does not offer registration" + (same_view ? "" : " of images of other proportions") +
                        "; choose software (with a calibration file), auto or off");
    }
  } else if (device_.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_OFF)) {
    device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_OFF);
  }
  by_software_ = !by_device_ && wanted != "off" && options_.calibration.has_value();
  if (!by_device_ && !by_software_ && wanted == "auto") {
    options_.warn("camera '" + info_.uri +
                  "' offers no registration, and no calibration file was given: depth and colour will not show quite the same points");
  }
  calibration_ = is_registered() ? RgbdCalibration{colour_camera_of_depth(), sensor_calibration_.colour, SE3()} : sensor_calibration_;
}

void CameraDevice::start() {
  options_.is_doing("starting the streams");
  depth_.addNewFrameListener(&depth_listener_);
  if (has_colour()) colour_.addNewFrameListener(&colour_listener_);
  is_listening_ = true;
  for (openni::VideoStream* stream : {&depth_, &colour_}) {
    if (!stream->isValid() || stream->start() == openni::STATUS_OK) continue;
    throw DeviceError("camera '" + info_.uri + "': its " + (stream == &depth_ ? "depth" : "colour") +
                      " stream does not start (OpenNI2 says: " + openni_error() +
                      "). The USB may lack bandwidth: use a port of the computer itself, without other cameras on the same hub.");
  }
  if (options_.synchronise && has_colour())
    device_.setDepthColorSyncEnabled(true);  // pairing by time does without, where the camera cannot do it
}

void CameraDevice::close() {
  options_.is_doing("closing the camera");
  if (device_.isValid()) device_.setDepthColorSyncEnabled(false);
  for (openni::VideoStream* stream : {&depth_, &colour_}) {
    if (!stream->isValid()) continue;
    if (is_listening_) stream->removeNewFrameListener(stream == &depth_ ? &depth_listener_ : &colour_listener_);
    stream->stop();
    stream->destroy();
  }
  if (device_.isValid()) device_.close();
  options_.is_doing("");
}

std::optional<openni::VideoFrameRef> CameraDevice::take(openni::VideoStream& stream, std::atomic<bool>& arrived) {
  if (!arrived.exchange(false)) return std::nullopt;
  // readFrame() waits without a limit if there is nothing to read, so that is asked first.
  openni::VideoStream* streams[] = {&stream};
  int ready = -1;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, openni::TIMEOUT_NONE) != openni::STATUS_OK) return std::nullopt;
  openni::VideoFrameRef image;
  if (stream.readFrame(&image) != openni::STATUS_OK || !image.isValid()) return std::nullopt;
  return image;
}

bool CameraDevice::convert(const openni::VideoFrameRef& depth, const openni::VideoFrameRef& colour, RgbdFrame& frame) const {
  if (!holds<openni::DepthPixel>(depth, depth_size_)) return false;
  const float units_per_m = depth.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 10000.0F : 1000.0F;
  copy_image<openni::DepthPixel>(depth, depth_mirrored_, frame.depth,
                                 [units_per_m](openni::DepthPixel z) { return static_cast<float>(z) / units_per_m; });
  if (has_colour()) {
    if (!holds<openni::RGB888Pixel>(colour, colour_size_)) return false;
    copy_image<openni::RGB888Pixel>(colour, colour_mirrored_, frame.colour, [](const openni::RGB888Pixel& c) {
      return Rgb8{c.r, c.g, c.b};
    });
  } else {
    frame.colour = Image<Rgb8>(depth_size_.width, depth_size_.height, kGrey);
  }
  if (by_software_) {
    Image<float> registered;
    register_depth_to_colour(frame.depth, {sensor_calibration_.depth, calibration_.depth, sensor_calibration_.depth_from_colour},
                             registered);
    frame.depth = std::move(registered);
  }
  frame.calibration = calibration_;
  return true;
}

void CameraDevice::lock_exposure() {
  const OpenNISettings& settings = options_.settings;
  if (!settings.lock_exposure && !settings.lock_white_balance) return;
  options_.is_doing("locking exposure and white balance");
  openni::CameraSettings* camera = has_colour() ? colour_.getCameraSettings() : nullptr;
  if (settings.lock_exposure && (camera == nullptr || camera->setAutoExposureEnabled(false) != openni::STATUS_OK)) {
    options_.warn("camera '" + info_.uri + "' cannot lock its exposure");
  }
  if (settings.lock_white_balance && (camera == nullptr || camera->setAutoWhiteBalanceEnabled(false) != openni::STATUS_OK)) {
    options_.warn("camera '" + info_.uri + "' cannot lock its white balance");
  }
}

}  // namespace foothold::capture
