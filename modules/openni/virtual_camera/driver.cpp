// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// An OpenNI2 driver whose devices play sequences: the real library, the real API, no hardware. See docs/cameras.md, "The virtual camera".

// OniDriverAPI.h allocates the driver through these two, which belong to a library that Debian does not ship.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

#include <Driver/OniDriverAPI.h>
#include <sys/file.h>
#include <unistd.h>

#include <fcntl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "camera_stream.h"
#include "foothold/base/error.h"
#include "pattern_sequence.h"
#include "player.h"
#include "script.h"
#ifdef FOOTHOLD_VIRTUAL_CAMERA_IO
#include "foothold/io/sequence.h"
#endif

namespace foothold::virtual_camera {
namespace {

std::shared_ptr<const Sequence> open_camera_sequence(const std::string& specification) {
  const std::string pattern = "pattern:";
  if (specification.compare(0, pattern.size(), pattern) == 0)
    return std::make_shared<PatternSequence>(specification.substr(pattern.size()));
#ifdef FOOTHOLD_VIRTUAL_CAMERA_IO
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;  // a camera's sensors know nothing of each other
  as_recorded.check = false;            // nobody would hear
  return open_sequence(specification, Context(), as_recorded);
#else
  throw InvalidSettings("FOOTHOLD_VIRTUAL_CAMERA: got '" + specification +
                        "', but this build without module io knows only pattern:WIDTHxHEIGHT");
#endif
}

/// True if depth and colour pixels already show the same points.
bool is_registered(const RgbdCalibration& calibration) {
  const Intrinsics& d = calibration.depth;
  const Intrinsics& c = calibration.colour;
  const float intrinsics_px =
      std::max(std::max(std::abs(d.fx - c.fx), std::abs(d.fy - c.fy)), std::max(std::abs(d.cx - c.cx), std::abs(d.cy - c.cy)));
  return intrinsics_px < 1e-3F && calibration.depth_from_colour.translation.norm() < 1e-6F &&
         rotation_distance_rad(calibration.depth_from_colour, SE3()) < 1e-6F;
}

/// A lock that another process may hold, as USB interfaces are held. Empty file names are never locked.
class FileLock {
 public:
  bool acquire(const std::string& file) {
    if (file.empty()) return true;
    descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return true;
    release();
    return false;
  }
  void release() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_ = -1;
};

/// One camera on the virtual bus.
struct Camera {
  OniDeviceInfo info{};
  Script script;
  Delays delays;
  std::vector<SensorDescription> sensors;
  bool registers = false;
  FileLock lock;
  std::unique_ptr<Player> player;
};

class VirtualDevice : public oni::driver::DeviceBase {
 public:
  explicit VirtualDevice(Camera& camera) : camera_(camera), connection_(camera.player->connection()) {
    for (SensorDescription& sensor : camera_.sensors) {
      const OniSensorType type = sensor.sensor == Sensor::kDepth ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR;
      sensor_infos_.push_back({type, static_cast<int>(sensor.modes.size()), sensor.modes.data()});
    }
  }

  Camera& camera() { return camera_; }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* num_sensors) override {
    *sensors = sensor_infos_.data();
    *num_sensors = static_cast<int>(sensor_infos_.size());
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    for (const SensorDescription& sensor : camera_.sensors) {
      const bool matches = type == (sensor.sensor == Sensor::kDepth ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR);
      if (matches) return new CameraStream(*camera_.player, connection_, sensor, camera_.delays);
    }
    return nullptr;
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniStatus setProperty(int id, const void* data, int size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || size != static_cast<int>(sizeof(registration_))) return ONI_STATUS_NOT_SUPPORTED;
    OniImageRegistrationMode wanted;
    std::memcpy(&wanted, data, sizeof(wanted));
    if (isImageRegistrationModeSupported(wanted) != TRUE) return ONI_STATUS_NOT_SUPPORTED;
    registration_ = wanted;
    return ONI_STATUS_OK;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || *size < static_cast<int>(sizeof(registration_))) return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(data, &registration_, sizeof(registration_));
    *size = static_cast<int>(sizeof(registration_));
    return ONI_STATUS_OK;
  }
  OniBool isPropertySupported(int id) override { return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? TRUE : FALSE; }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override {
    return mode == ONI_IMAGE_REGISTRATION_OFF || camera_.registers ? TRUE : FALSE;
  }

 private:
  Camera& camera_;
  const int connection_;
  std::vector<OniSensorInfo> sensor_infos_;
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
};

}  // namespace

class VirtualDriver : public oni::driver::DriverBase {
 public:
  explicit VirtualDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected, oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    try {
      const Script script = read_script([](const char* name) { return std::getenv(name); });
      for (const std::string& sequence : script.sequences) plug_in(sequence, script);
    } catch (const std::exception& error) {
      report(error.what());
      return ONI_STATUS_ERROR;
    }
    for (const auto& camera : cameras_) deviceConnected(&camera->info);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    Camera* camera = find(uri);
    if (camera == nullptr || camera->player->connection() < 0) return nullptr;
    delay(camera->delays.open_s);
    if (!camera->lock.acquire(camera->script.lock_file)) {
      report("Could not open '" + std::string(uri) + "': USB is busy!");
      return nullptr;
    }
    return new VirtualDevice(*camera);
  }

  void deviceClose(oni::driver::DeviceBase* device) override {
    Camera& camera = static_cast<VirtualDevice*>(device)->camera();
    delay(camera.delays.close_s);
    camera.lock.release();
    delete device;
  }

  OniStatus tryDevice(const char* uri) override { return find(uri) != nullptr ? ONI_STATUS_OK : ONI_STATUS_ERROR; }

  void* enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*num_streams*/) override {
    return !cameras_.empty() && cameras_.front()->script.synchronises ? this : nullptr;  // both sensors share one clock
  }
  void disableFrameSync(void* /*group*/) override {}

  void shutdown() override { stop(); }

  /// Ends every thread. Safe to call at process exit, when the host's library is about to be taken down.
  void stop() {
    for (const auto& camera : cameras_) camera->player->stop();
  }

 private:
  void report(const std::string& message) { getServices().errorLoggerAppend("%s", message.c_str()); }

  /// For threads whose errors no caller can fetch.
  void log(const std::string& message) {
    constexpr int kError = 3;
    getServices().log(kError, __FILE__, __LINE__, "FootholdVirtualCamera", message.c_str());
  }

  Camera* find(const char* uri) {
    for (const auto& camera : cameras_) {
      if (std::strcmp(camera->info.uri, uri) == 0) return camera.get();
    }
    return nullptr;
  }

  void plug_in(const std::string& specification, const Script& script) {
    const std::shared_ptr<const Sequence> sequence = open_camera_sequence(specification);
    const RgbdFrame first = sequence->load(0);
    auto camera = std::make_unique<Camera>();
    camera->script = script;
    if (!cameras_.empty()) camera->script.events.clear();
    if (cameras_.size() < script.delays.size()) camera->delays = script.delays[cameras_.size()];
    std::snprintf(camera->info.uri, sizeof(camera->info.uri), "foothold://%zu", cameras_.size());
    std::snprintf(camera->info.vendor, sizeof(camera->info.vendor), "Foothold");
    std::snprintf(camera->info.name, sizeof(camera->info.name), "Virtual camera (%s)", sequence->name().c_str());
    if (script.has_depth) camera->sensors.push_back(describe_sensor(Sensor::kDepth, first, script));
    if (script.has_colour) camera->sensors.push_back(describe_sensor(Sensor::kColour, first, script));
    camera->registers = script.registers && is_registered(first.calibration);
    const OniDeviceInfo* info = &camera->info;
    camera->player =
        std::make_unique<Player>(camera->script, sequence,
                                 Player::Callbacks{[this, info] { deviceConnected(info); }, [this, info] { deviceDisconnected(info); },
                                                   [this](const std::string& message) { log(message); }});
    cameras_.push_back(std::move(camera));
  }

  std::vector<std::unique_ptr<Camera>> cameras_;
};

}  // namespace foothold::virtual_camera

ONI_EXPORT_DRIVER(foothold::virtual_camera::VirtualDriver)

namespace {

/// A host may exit without shutting OpenNI2 down: frames must stop before the library's own objects are destroyed.
void stop_at_exit() {
  if (g_pDriver != nullptr) static_cast<foothold::virtual_camera::VirtualDriver*>(g_pDriver)->stop();
}
[[maybe_unused]] const int kAtExit = std::atexit(stop_at_exit);

}  // namespace
