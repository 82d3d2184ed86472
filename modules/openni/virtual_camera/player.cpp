// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "player.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace foothold::virtual_camera {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(1);  ///< how long to wait for a host that is inside a callback

/// Where a stream's frames go.
struct Outlet {
  Player::Sink sink;           ///< empty while the stream is closed
  bool is_delivering = false;  ///< the sink is being called, without any lock held
};

void cover(RgbdFrame& frame) {
  frame.depth = Image<float>(frame.depth.width(), frame.depth.height(), 0.0F);
  frame.colour = Image<Rgb8>(frame.colour.width(), frame.colour.height());
}

}  // namespace

struct Player::State {
  State(Script s, std::shared_ptr<const Sequence> q, Callbacks c) : script(std::move(s)), sequence(std::move(q)), callbacks(std::move(c)) {}

  const Script script;
  const std::shared_ptr<const Sequence> sequence;
  const Callbacks callbacks;

  std::mutex mutex;  // guards what follows
  std::condition_variable changed;
  std::array<Outlet, 2> outlets;
  bool connected = true;
  int connection = 0;
  bool stopping = false;
  bool finished = false;

  // The thread's own:
  std::int64_t tick = 0;
  std::int64_t playhead = 0;
  Clock::time_point deadline = Clock::now();

  Clock::duration period() const {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / script.frames_per_second));
  }
  bool any_open() const { return outlets[0].sink || outlets[1].sink; }

  /// Waits for the next tick of the clock. @return False if the camera stops.
  bool wait_for_tick() {
    deadline = std::max(deadline + period(), Clock::now());
    std::unique_lock<std::mutex> lock(mutex);
    return !changed.wait_until(lock, deadline, [this] { return stopping; });
  }

  /// Lets the world move on by one frame. @return The frame of the sequence now seen, or -1 if the camera has gone for good.
  int advance() {
    if (const std::int64_t target = script.jump_target(tick); target >= 0) playhead = target;
    const int index = frame_at(playhead, sequence->num_frames(), script.at_end);
    if (!script.is_active(Event::Kind::kFreeze, tick)) ++playhead;
    return index;
  }

  /// Plugs or unplugs the device as the script wants it. Streams do not survive unplugging.
  void set_connected(bool wanted) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (connected == wanted) return;
      connected = wanted;
      if (wanted) {
        ++connection;
      } else {
        for (Outlet& outlet : outlets) outlet.sink = nullptr;
      }
    }
    (wanted ? callbacks.connected : callbacks.disconnected)();
  }

  void deliver(Sensor sensor, const Shot& shot) {
    std::unique_lock<std::mutex> lock(mutex);
    Outlet& outlet = outlets[static_cast<std::size_t>(sensor)];
    if (!outlet.sink) return;
    const Sink sink = outlet.sink;
    outlet.is_delivering = true;
    lock.unlock();  // the host takes locks of its own
    sink(shot);
    lock.lock();
    outlet.is_delivering = false;
    changed.notify_all();
  }

  void send(int index) {
    RgbdFrame frame;
    try {
      frame = sequence->load(index);
    } catch (const std::exception& error) {
      callbacks.failed(error.what());
      wait_for_tick();
      return;
    }
    if (script.is_active(Event::Kind::kCover, tick)) cover(frame);
    if (!wait_for_tick()) return;
    const Shot shot{frame, static_cast<int>(tick), static_cast<std::uint64_t>(static_cast<double>(tick) * 1e6 / script.frames_per_second)};
    if (!script.is_active(Event::Kind::kNoDepth, tick)) deliver(Sensor::kDepth, shot);
    if (!script.is_active(Event::Kind::kNoColour, tick)) deliver(Sensor::kColour, shot);
  }

  /// One period of the clock.
  void step() {
    const int index = advance();
    if (index < 0 || script.is_active(Event::Kind::kUnplug, tick)) {
      if (wait_for_tick()) set_connected(false);
    } else if (script.is_active(Event::Kind::kStall, tick)) {
      wait_for_tick();
    } else {
      send(index);
    }
    ++tick;
  }
};

Player::Player(Script script, std::shared_ptr<const Sequence> sequence, Callbacks callbacks)
    : state_(std::make_shared<State>(std::move(script), std::move(sequence), std::move(callbacks))), thread_(run, state_) {}

Player::~Player() { stop(); }

void Player::run(const std::shared_ptr<State>& state) {
  while (true) {
    {
      std::unique_lock<std::mutex> lock(state->mutex);
      const bool replugs = !state->connected && state->script.is_active(Event::Kind::kUnplug, state->tick);
      if (!replugs && !state->stopping && !state->any_open()) {
        // Connected or about to be, with nobody watching: announce the device, then stand still.
        if (!state->connected && frame_at(state->playhead, state->sequence->num_frames(), state->script.at_end) >= 0) {
          lock.unlock();
          state->set_connected(true);
          lock.lock();
        }
        state->changed.wait(lock, [&] { return state->stopping || state->any_open(); });
      }
      if (state->stopping) break;
    }
    state->step();
  }
  const std::lock_guard<std::mutex> lock(state->mutex);
  state->finished = true;
  state->changed.notify_all();
}

bool Player::open_stream(int connection, Sensor sensor, Sink sink) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (!state_->connected || connection != state_->connection) return false;
  state_->outlets[static_cast<std::size_t>(sensor)].sink = std::move(sink);
  state_->changed.notify_all();
  return true;
}

void Player::close_stream(int connection, Sensor sensor) {
  std::unique_lock<std::mutex> lock(state_->mutex);
  Outlet& outlet = state_->outlets[static_cast<std::size_t>(sensor)];
  if (connection == state_->connection) outlet.sink = nullptr;
  state_->changed.wait_for(lock, kPatience, [&] { return !outlet.is_delivering; });
}

int Player::connection() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->connected ? state_->connection : -1;
}

void Player::stop() {
  if (!thread_.joinable()) return;
  bool finished = false;
  {
    std::unique_lock<std::mutex> lock(state_->mutex);
    state_->stopping = true;
    state_->changed.notify_all();
    finished = state_->changed.wait_for(lock, kPatience, [this] { return state_->finished; });
  }
  finished ? thread_.join() : thread_.detach();
}

}  // namespace foothold::virtual_camera
