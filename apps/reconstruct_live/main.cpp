// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// reconstruct_live: reconstructs what a camera sees that OpenNI2 drives, and finds the camera again when it is lost.
#include <cstdio>
#include <string>
#include <vector>

#include "common/app_main.h"
#include "foothold/openni/openni_source.h"
#include "live_run.h"
#include "options.h"

namespace foothold::live {
namespace {

int list_devices() {
  const std::vector<OpenNIDeviceInfo> devices = list_openni_devices();
  if (devices.empty()) throw DeviceError(openni_no_device_advice());
  std::fputs(describe_devices(devices).c_str(), stdout);
  return apps::kSuccess;
}

int run(const LiveOptions& options) {
  if (options.list_devices) return list_devices();
  return LiveRun(options, live_settings(options)).run();
}

}  // namespace
}  // namespace foothold::live

int main(int argc, char** argv) {
  foothold::apps::CommandLine app("Reconstructs what a depth camera sees, live, and finds the camera again when it is lost.",
                                  "reconstruct_live");
  foothold::live::LiveOptions options;
  foothold::live::add_live_options(app, options);
  return foothold::apps::run_app(app, argc, argv, [&] { return foothold::live::run(options); });
}
