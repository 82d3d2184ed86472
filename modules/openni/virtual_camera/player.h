// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The clock of one virtual camera: plays a sequence, follows the script, and hands frames to whoever has a stream open.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "foothold/api/frame_source.h"
#include "script.h"

namespace foothold::virtual_camera {

/// What the lens sees at one tick of the camera's clock.
struct Shot {
  const RgbdFrame& frame;
  int tick = 0;
  std::uint64_t timestamp_us = 0;
};

enum class Sensor { kDepth = 0, kColour = 1 };

/// The camera's world and clock. It outlives open devices, so that time goes on while the camera is unplugged.
///
/// The clock runs while a stream is open or the device is unplugged, and stands still otherwise: the first frame that a program receives is
/// always the first of the script. Every frame is sent, late if the sequence cannot be read fast enough, never in a burst.
class Player {
 public:
  using Sink = std::function<void(const Shot&)>;
  struct Callbacks {
    std::function<void()> connected;
    std::function<void()> disconnected;
    std::function<void(const std::string&)> failed;  ///< the sequence cannot be read any more
  };

  Player(Script script, std::shared_ptr<const Sequence> sequence, Callbacks callbacks);
  /// Ends the clock; waits for it for a bounded time.
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// The number of this connection, counted up at every replug; -1 while unplugged.
  int connection() const;
  /// Sends a sensor's frames to a sink from now on, until close_stream() or unplugging. @return False if that connection is over.
  bool open_stream(int connection, Sensor sensor, Sink sink);
  /// Sends no more frames once it returns; gives up waiting for one in flight after a second.
  void close_stream(int connection, Sensor sensor);
  /// Ends the clock for good; callable more than once.
  void stop();

 private:
  struct State;
  static void run(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;  // shared with the thread, which a host that blocks in a callback may force us to abandon
  std::thread thread_;
};

}  // namespace foothold::virtual_camera
