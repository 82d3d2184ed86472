// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// One open camera with its depth and colour stream. Every call may block for as long as the driver likes.
#pragma once

#include <OpenNI.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/openni/openni_source.h"

namespace foothold::capture {

/// The size of a sensor's images [px].
struct ModeSize {
  int width = 0;
  int height = 0;
};

/// A camera whose streams run.
class CameraDevice {
 public:
  struct Options {
    const OpenNISettings& settings;
    const std::optional<RgbdCalibration>& calibration;
    bool synchronise = true;
    std::function<void()> wake;                        ///< called by a thread of OpenNI2's when an image has arrived
    std::function<void(const std::string&)> is_doing;  ///< told what the next calls into the driver are for; empty when they are over
    std::function<void(const std::string&)> warn;      ///< told what could not be had
  };

  /// Opens a camera, chooses its modes and starts its streams. @throws DeviceError, InvalidSettings
  CameraDevice(const std::string& uri, const Options& options);
  ~CameraDevice();
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;

  const OpenNIDeviceInfo& info() const { return info_; }
  /// The calibration of the frames that convert() makes.
  const RgbdCalibration& calibration() const { return calibration_; }
  bool is_registered() const { return by_device_ || by_software_ || !has_colour(); }
  /// False for cameras that have no colour sensor, whose frames are grey.
  bool has_colour() const { return colour_.isValid(); }

  /// The newest depth or colour image if it has not been taken yet; never waits.
  std::optional<openni::VideoFrameRef> take_depth() { return take(depth_, depth_arrived_); }
  std::optional<openni::VideoFrameRef> take_colour() { return take(colour_, colour_arrived_); }

  /// Fills a frame's images and calibration. @return False if the images are not of the mode that was asked for.
  /// @pre The colour image is valid, unless the camera has no colour sensor.
  bool convert(const openni::VideoFrameRef& depth, const openni::VideoFrameRef& colour, RgbdFrame& frame) const;

  /// Stops automatic exposure and white balance where the settings want it.
  void lock_exposure();

 private:
  class Listener : public openni::VideoStream::NewFrameListener {
   public:
    Listener(std::atomic<bool>& arrived, const std::function<void()>& wake) : arrived_(arrived), wake_(wake) {}
    void onNewFrame(openni::VideoStream& /*stream*/) override {
      arrived_ = true;
      wake_();
    }

   private:
    std::atomic<bool>& arrived_;
    std::function<void()> wake_;
  };

  void open(const std::string& uri);
  void create_stream(openni::VideoStream& stream, openni::SensorType sensor, const std::vector<openni::PixelFormat>& formats);
  void register_images();
  /// The colour camera at depth's resolution: the one that sees registered depth.
  Intrinsics colour_camera_of_depth() const;
  void start();
  void close();
  static std::optional<openni::VideoFrameRef> take(openni::VideoStream& stream, std::atomic<bool>& arrived);

  Options options_;
  ModeSize depth_size_;
  ModeSize colour_size_;
  OpenNIDeviceInfo info_;
  RgbdCalibration sensor_calibration_;  // of the images as they arrive
  RgbdCalibration calibration_;         // of the images as they are delivered
  bool by_device_ = false;
  bool by_software_ = false;
  bool depth_mirrored_ = false;  // the driver mirrors its images whatever it is told
  bool colour_mirrored_ = false;
  bool is_listening_ = false;
  std::atomic<bool> depth_arrived_{false};
  std::atomic<bool> colour_arrived_{false};
  openni::Device device_;
  openni::VideoStream depth_;
  openni::VideoStream colour_;
  Listener depth_listener_;
  Listener colour_listener_;
};

}  // namespace foothold::capture
