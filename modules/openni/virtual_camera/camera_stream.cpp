// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "camera_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <thread>

namespace foothold::virtual_camera {
namespace {

constexpr int kMaxDepth = 65535;

/// Writes a property into the caller's buffer.
template <class T>
OniStatus put(const T& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  *size = static_cast<int>(sizeof(T));
  return ONI_STATUS_OK;
}

template <class T>
OniStatus take(T& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof(T));
  return ONI_STATUS_OK;
}

bool operator==(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY && a.fps == b.fps;
}

int bytes_per_pixel(const OniVideoMode& mode) { return mode.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2; }

/// The angle between the outer edges of the first and the last pixel.
float field_of_view_rad(float focal_length_px, float centre_px, int size) {
  return std::atan((centre_px + 0.5F) / focal_length_px) + std::atan((static_cast<float>(size) - 0.5F - centre_px) / focal_length_px);
}

}  // namespace

void delay(double seconds) {
  if (seconds > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

SensorDescription describe_sensor(Sensor sensor, const RgbdFrame& frame, const Script& script) {
  const bool is_depth = sensor == Sensor::kDepth;
  const Intrinsics& intrinsics = is_depth ? frame.calibration.depth : frame.calibration.colour;
  const int width = is_depth ? frame.depth.width() : frame.colour.width();
  const int height = is_depth ? frame.depth.height() : frame.colour.height();
  const int fps = static_cast<int>(std::lround(script.frames_per_second));

  SensorDescription description;
  description.sensor = sensor;
  description.horizontal_fov_rad = field_of_view_rad(intrinsics.fx, intrinsics.cx, width);
  description.vertical_fov_rad = field_of_view_rad(intrinsics.fy, intrinsics.cy, height);
  for (const int divisor : {1, 2}) {
    if (width % divisor != 0 || height % divisor != 0) continue;
    if (is_depth) {
      if (!script.fine_depth) description.modes.push_back({ONI_PIXEL_FORMAT_DEPTH_1_MM, width / divisor, height / divisor, fps});
      description.modes.push_back({ONI_PIXEL_FORMAT_DEPTH_100_UM, width / divisor, height / divisor, fps});
    } else {
      description.modes.push_back({ONI_PIXEL_FORMAT_RGB888, width / divisor, height / divisor, fps});
    }
  }
  return description;
}

CameraStream::CameraStream(Player& player, int connection, const SensorDescription& description, const Delays& delays)
    : player_(player), connection_(connection), description_(description), delays_(delays), mode_(description.modes.front()) {}

CameraStream::~CameraStream() {
  if (running_) player_.close_stream(connection_, description_.sensor);
}

OniStatus CameraStream::start() {
  delay(delays_.start_s);
  running_ = player_.open_stream(connection_, description_.sensor, [this](const Shot& shot) { send(shot); });
  return running_ ? ONI_STATUS_OK : ONI_STATUS_ERROR;
}

void CameraStream::stop() {
  delay(delays_.stop_s);
  player_.close_stream(connection_, description_.sensor);
  running_ = false;
}

OniStatus CameraStream::setProperty(int id, const void* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE: {
      OniVideoMode mode;
      if (take(mode, data, size) != ONI_STATUS_OK) return ONI_STATUS_BAD_PARAMETER;
      if (running_) return ONI_STATUS_OUT_OF_FLOW;
      const auto& modes = description_.modes;
      if (std::none_of(modes.begin(), modes.end(), [&](const OniVideoMode& known) { return known == mode; }))
        return ONI_STATUS_BAD_PARAMETER;
      mode_ = mode;
      return ONI_STATUS_OK;
    }
    case ONI_STREAM_PROPERTY_MIRRORING:
      return take(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return take(auto_exposure_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return take(auto_white_balance_, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus CameraStream::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return put(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return put(description_.horizontal_fov_rad, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return put(description_.vertical_fov_rad, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return put(0, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return put(description_.sensor == Sensor::kDepth ? kMaxDepth : 255, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return put(mode_.resolutionX * bytes_per_pixel(mode_), data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return put(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return put(auto_exposure_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return put(auto_white_balance_, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool CameraStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_MIRRORING:
      return TRUE;
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return description_.sensor == Sensor::kColour ? TRUE : FALSE;
    default:
      return FALSE;
  }
}

int CameraStream::getRequiredFrameSize() { return mode_.resolutionX * mode_.resolutionY * bytes_per_pixel(mode_); }

void CameraStream::send(const Shot& shot) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  frame->sensorType = description_.sensor == Sensor::kDepth ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR;
  frame->timestamp = shot.timestamp_us;
  frame->frameIndex = shot.tick;
  frame->videoMode = mode_;
  frame->width = mode_.resolutionX;
  frame->height = mode_.resolutionY;
  frame->croppingEnabled = FALSE;
  frame->cropOriginX = 0;
  frame->cropOriginY = 0;
  frame->stride = mode_.resolutionX * bytes_per_pixel(mode_);
  frame->dataSize = getRequiredFrameSize();
  fill(shot.frame, *frame);
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

/// Half-size images take every second pixel of every second row, so that no depth is ever invented between two surfaces.
void CameraStream::fill(const RgbdFrame& source, OniFrame& frame) const {
  const int step = (description_.sensor == Sensor::kDepth ? source.depth.width() : source.colour.width()) / frame.width;
  const float units_per_m = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 1e4F : 1e3F;
  for (int v = 0; v < frame.height; ++v) {
    auto* row = static_cast<std::uint8_t*>(frame.data) + v * frame.stride;
    for (int u = 0; u < frame.width; ++u) {
      const int target = mirrored_ == TRUE ? frame.width - 1 - u : u;
      if (description_.sensor == Sensor::kDepth) {
        const float depth_m = source.depth(u * step, v * step);
        const float units = is_valid_depth(depth_m) ? std::round(depth_m * units_per_m) : 0.0F;
        const auto value = static_cast<std::uint16_t>(units <= static_cast<float>(kMaxDepth) ? units : 0.0F);
        std::memcpy(row + 2 * target, &value, sizeof(value));
      } else {
        const Rgb8 colour = source.colour(u * step, v * step);
        std::memcpy(row + 3 * target, &colour, sizeof(colour));
      }
    }
  }
}

}  // namespace foothold::virtual_camera
