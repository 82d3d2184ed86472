// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// RGB-D cameras that OpenNI2 drives, as a source of frames. No OpenNI2 type shows here.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/base/settings.h"

namespace foothold {

/// A mode that a sensor offers.
struct OpenNIVideoMode {
  int width = 0;       ///< columns [px]
  int height = 0;      ///< rows [px]
  int fps = 0;         ///< frames per second [Hz]
  std::string format;  ///< e.g. "depth 1 mm" or "RGB 8 bit"
};

/// A camera that OpenNI2 has found.
struct OpenNIDeviceInfo {
  std::string uri;         ///< changes when the camera is plugged into another port, and with PrimeSense's driver at every replug
  std::string vendor;      ///< as the driver gives it
  std::string name;        ///< as the driver gives it
  int usb_vendor_id = 0;   ///< as the driver gives it
  int usb_product_id = 0;  ///< as the driver gives it
  std::vector<OpenNIVideoMode> depth_modes;   ///< empty if the camera could not be opened to ask
  std::vector<OpenNIVideoMode> colour_modes;  ///< likewise
};

/// Lists the cameras that OpenNI2 sees, in the order of their indices. Each is opened for a moment to ask for its modes.
/// @return Empty if there is none; openni_no_device_advice() then says what to look for.
/// @throws DeviceError if OpenNI2 has no drivers, or a driver does not answer within the time limit.
std::vector<OpenNIDeviceInfo> list_openni_devices(int time_limit_ms = 15000);

/// What to do when no camera is found, judged from what is on the USB.
std::string openni_no_device_advice();

/// How an OpenNI2 camera is chosen and run. These are properties of cameras, not of the method: none has an origin in the paper.
struct OpenNISettings {
  /// Empty for the first camera, an index such as "1", a URI as list_openni_devices() gives, or the path of an .oni recording.
  std::string device;
  int width = 640;        ///< 640x480 at 30 Hz is the mode that every PrimeSense camera has
  int height = 480;       ///< of the depth image [px]
  int colour_width = 0;   ///< 0 for that of depth, as is the height's
  int colour_height = 0;  ///< of the colour image [px]
  int fps = 30;           ///< frames per second of both images [Hz]
  /// Brings depth into the colour camera: "device" by the camera; "software" by Foothold, from the calibration; "off" not at all; "auto":
  /// the first of the former that is possible.
  std::string registration = "auto";
  bool synchronise = true;          ///< asks the camera to expose depth and colour at the same time
  bool lock_exposure = false;       ///< keeps exposure as it is once it has settled
  bool lock_white_balance = false;  ///< keeps white balance as it is once it has settled
  int settle_ms = 1000;             ///< automatic exposure and white balance run this long before they are locked
  int pair_tolerance_ms = 0;        ///< depth and colour further apart are no pair; 0 means half a frame
  int open_timeout_ms = 15000;      ///< a PrimeSense camera takes 1 to 3 s to open
  int read_timeout_ms = 1000;       ///< the next pair is waited for no longer than this
  int silence_timeout_ms = 3000;    ///< without pairs for so long, the camera is closed and opened again
  int close_timeout_ms = 5000;      ///< a driver that has not closed by then is left behind

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&OpenNISettings::device, "device", "Empty for the first camera, an index, a URI, or an .oni file.");
    v(&OpenNISettings::width, "width", "Width of depth images, and of colour unless told [px].", Range{16, 4096});
    v(&OpenNISettings::height, "height", "Height of depth images, and of colour unless told [px].", Range{16, 4096});
    v(&OpenNISettings::colour_width, "colour_width", "Width of colour images [px]; 0 for that of depth.", Range{0, 4096});
    v(&OpenNISettings::colour_height, "colour_height", "Height of colour images [px]; 0 for that of depth.", Range{0, 4096});
    v(&OpenNISettings::fps, "fps", "Frames per second.", Range{1, 1000});
    v(&OpenNISettings::registration, "registration", "Depth-to-colour registration: auto, device, software or off.");
    v(&OpenNISettings::synchronise, "synchronise", "Ask the camera to expose depth and colour at the same time.");
    v(&OpenNISettings::lock_exposure, "lock_exposure", "Lock the exposure once it has settled.");
    v(&OpenNISettings::lock_white_balance, "lock_white_balance", "Lock the white balance once it has settled.");
    v(&OpenNISettings::settle_ms, "settle_ms", "Time before exposure and white balance are locked [ms].", Range{0, 60000});
    v(&OpenNISettings::pair_tolerance_ms, "pair_tolerance_ms",
      "Largest time between the depth and the colour of a pair [ms]; 0 for half a frame.", Range{0, 1000});
    v(&OpenNISettings::open_timeout_ms, "open_timeout_ms", "Time limit for opening the camera [ms].", Range{100, 600000});
    v(&OpenNISettings::read_timeout_ms, "read_timeout_ms", "Time limit for one read [ms].", Range{1, 60000});
    v(&OpenNISettings::silence_timeout_ms, "silence_timeout_ms", "Time without frames after which the camera is opened anew [ms].",
      Range{100, 600000});
    v(&OpenNISettings::close_timeout_ms, "close_timeout_ms", "Time limit for closing the camera [ms].", Range{100, 60000});
  }
  /// @throws InvalidSettings
  void validate() const;
};

/// How the camera is doing.
enum class OpenNIState {
  kStreaming,         ///< pairs arrive
  kSilent,            ///< connected, but no pairs arrive
  kWaitingForDevice,  ///< unplugged or not to be opened; it is opened again when that changes
  kNotAnswering,      ///< a call into the driver has not returned for longer than the silence timeout
  kEnded,             ///< a recording is over
};

/// The state of a camera, with words for people.
struct OpenNIStatus {
  OpenNIState state = OpenNIState::kStreaming;  ///< streaming, or what keeps it from that
  std::string message;                          ///< what is wrong and what to do about it; empty while streaming
  OpenNIDeviceInfo device;                      ///< the camera, as far as it is known
  bool registered = false;                      ///< depth and colour show the same points
  std::int64_t num_pairs = 0;                   ///< pairs that arrived
  std::int64_t num_skipped = 0;                 ///< pairs that were replaced by newer ones before anybody read them
  std::int64_t num_unmatched = 0;               ///< depth or colour images that found no partner in time
  std::int64_t num_reopened = 0;                ///< how often the camera came back after an unplug or a restart
};

/// A camera that OpenNI2 drives.
///
/// Every call into OpenNI2 is made by a thread of the source's own, and everybody else waits for that thread for a bounded time only: a
/// driver that hangs costs a time-out, never the program. A read delivers the newest pair; older ones are dropped and counted. When the
/// camera is unplugged or falls silent, reads time out, status() says why, and the camera is opened again as soon as possible.
class OpenNISource : public FrameSource {
 public:
  /// Opens the camera and starts its streams.
  ///
  /// @param calibration  Replaces the intrinsics that the camera reports; with its extrinsics, makes registration by software possible. It
  /// must
  ///                     belong to the sizes of the settings.
  /// @param log          Receives messages about unplugging and the like, within calls of the constructor, read() and the destructor.
  /// @throws InvalidSettings  for settings out of range, or a video mode that the camera does not offer; the message lists those it does.
  /// @throws FileError        if an .oni file does not exist.
  /// @throws DeviceError      if there is no such camera, it cannot be opened or does not answer in time; the message says what to do.
  explicit OpenNISource(const OpenNISettings& settings, const std::optional<RgbdCalibration>& calibration = {}, LogSink log = {});
  /// Closes the camera, within close_timeout_ms.
  ~OpenNISource() override;

  /// Waits for a pair that has not been delivered yet, for at most read_timeout_ms. Depth 0 means no measurement. The frame's index counts
  /// the camera's pairs, skipped ones included; its time starts with the source and never goes back. Where the settings ask for colour of
  /// another size than depth, register_colour() brings it to that of depth.
  ReadStatus read(RgbdFrame& frame) override;

  /// May be called from any thread.
  OpenNIStatus status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foothold
