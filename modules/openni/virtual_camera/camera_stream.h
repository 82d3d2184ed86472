// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A stream of the virtual camera, as OpenNI2 sees it.
#pragma once

#include <Driver/OniDriverAPI.h>

#include <vector>

#include "player.h"

namespace foothold::virtual_camera {

/// What a sensor of the camera can do.
struct SensorDescription {
  Sensor sensor = Sensor::kDepth;
  std::vector<OniVideoMode> modes;  ///< the first is the default
  float horizontal_fov_rad = 0.0F;
  float vertical_fov_rad = 0.0F;
};

/// The modes and fields of view of a sensor that shows a sequence: full and half size, depth in 1 mm and 0.1 mm.
SensorDescription describe_sensor(Sensor sensor, const RgbdFrame& frame, const Script& script);

/// Turns shots into OpenNI2 frames in the chosen mode. Like a PrimeSense camera it mirrors its images until told not to.
class CameraStream : public oni::driver::StreamBase {
 public:
  CameraStream(Player& player, int connection, const SensorDescription& description, const Delays& delays);
  ~CameraStream() override;

  OniStatus start() override;
  void stop() override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  int getRequiredFrameSize() override;

  Sensor sensor() const { return description_.sensor; }

 private:
  void send(const Shot& shot);
  void fill(const RgbdFrame& source, OniFrame& frame) const;

  Player& player_;
  const int connection_;
  const SensorDescription description_;
  const Delays delays_;
  OniVideoMode mode_;
  bool running_ = false;
  OniBool mirrored_ = TRUE;
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
};

/// Pretends to be a driver that is busy with something.
void delay(double seconds);

}  // namespace foothold::virtual_camera
