// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Opens the first camera as a careless program would, and ends without closing anything.
#include <OpenNI.h>

#include <cstdlib>
#include <cstring>

int main(int /*argc*/, char** argv) {
  if (openni::OpenNI::initialize() != openni::STATUS_OK) return 2;
  static auto* device = new openni::Device;  // never destroyed
  static auto* depth = new openni::VideoStream;
  if (device->open(openni::ANY_DEVICE) != openni::STATUS_OK) return 3;
  if (depth->create(*device, openni::SENSOR_DEPTH) != openni::STATUS_OK || depth->start() != openni::STATUS_OK) return 4;
  openni::VideoFrameRef image;
  for (int i = 0; i < 5; ++i) {
    if (depth->readFrame(&image) != openni::STATUS_OK) return 5;
  }
  image.release();
  if (std::strcmp(argv[1], "exit") == 0) std::exit(0);
  return 0;
}
