// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "script.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

#include "foothold/base/error.h"
#include "foothold/base/settings.h"

namespace foothold::virtual_camera {
namespace {

constexpr const char* kDefaultSequence = "pattern:";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string part = trimmed(text.substr(begin, end - begin));
    if (!part.empty()) parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

double parse_real(const std::string& what, const std::string& text, double low, double high) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);  // heeds no locale
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high)) {
    throw InvalidSettings(what + ": got '" + text + "', expected a number in [" + detail::to_text(low) + ", " + detail::to_text(high) +
                          "]");
  }
  return value;
}

/// Reads the digits at `position` and moves it behind them; -1 if there are none.
std::int64_t parse_count(const std::string& text, std::size_t& position) {
  const std::size_t begin = position;
  while (position < text.size() && text[position] >= '0' && text[position] <= '9') ++position;
  if (position == begin || position - begin > 12) return -1;
  return std::strtoll(text.substr(begin, position - begin).c_str(), nullptr, 10);
}

Event parse_event(const std::string& text) {
  static const std::pair<const char*, Event::Kind> kKinds[] = {
      {"unplug", Event::Kind::kUnplug},   {"stall", Event::Kind::kStall},       {"jump", Event::Kind::kJump},
      {"nodepth", Event::Kind::kNoDepth}, {"nocolour", Event::Kind::kNoColour}, {"cover", Event::Kind::kCover},
      {"freeze", Event::Kind::kFreeze},
  };
  const std::string wrong =
      "virtual camera event '" + text +
      "': expected kind@frame[+length][=target], where kind is unplug, stall, jump, nodepth, nocolour, cover or freeze, e.g. "
      "unplug@100+30 or jump@200=50";
  std::size_t position = text.find('@');
  if (position == std::string::npos) throw InvalidSettings(wrong);
  const std::string name = text.substr(0, position++);
  const auto* kind = std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& known) { return name == known.first; });
  if (kind == std::end(kKinds)) throw InvalidSettings(wrong);

  Event event;
  event.kind = kind->second;
  const bool is_jump = event.kind == Event::Kind::kJump;
  event.num_ticks = is_jump ? 1 : Event::kForever;
  event.first_tick = parse_count(text, position);
  if (!is_jump && position < text.size() && text[position] == '+') event.num_ticks = parse_count(text, ++position);
  if (is_jump) event.target = position < text.size() && text[position] == '=' ? parse_count(text, ++position) : -1;
  if (event.first_tick < 0 || event.num_ticks < 0 || event.target < 0 || position != text.size()) throw InvalidSettings(wrong);
  return event;
}

EndOfSequence parse_end(const std::string& text) {
  if (text == "hold") return EndOfSequence::kHold;
  if (text == "restart") return EndOfSequence::kRestart;
  if (text == "pingpong") return EndOfSequence::kPingPong;
  if (text == "unplug") return EndOfSequence::kUnplug;
  throw InvalidSettings("FOOTHOLD_VIRTUAL_CAMERA_AT_END: got '" + text + "', expected hold, restart, pingpong or unplug");
}

/// The delay that a name such as "open" stands for; null for an unknown one.
double* find_delay(Delays& delays, const std::string& name) {
  if (name == "open") return &delays.open_s;
  if (name == "start") return &delays.start_s;
  if (name == "stop") return &delays.stop_s;
  return name == "close" ? &delays.close_s : nullptr;
}

/// Reads "open=3, 1.close=60": the camera's number, 0 if left out, the call and the seconds.
std::vector<Delays> parse_delays(const std::string& text) {
  std::vector<Delays> delays;
  for (const std::string& part : split(text, ',')) {
    std::size_t position = 0;
    const std::int64_t number = parse_count(part, position);
    const std::size_t camera = number < 0 ? 0 : static_cast<std::size_t>(number);
    if (number >= 0 && position < part.size() && part[position] == '.') ++position;
    const std::size_t equals = std::min(part.find('=', position), part.size());
    if (camera >= delays.size()) delays.resize(std::min<std::size_t>(camera, 99) + 1);
    double* delay = camera < delays.size() ? find_delay(delays[camera], part.substr(position, equals - position)) : nullptr;
    if (delay == nullptr || equals == part.size()) {
      throw InvalidSettings("FOOTHOLD_VIRTUAL_CAMERA_DELAYS: got '" + part +
                            "', expected [CAMERA.]CALL=SECONDS, where CALL is open, start, stop or close");
    }
    *delay = parse_real("FOOTHOLD_VIRTUAL_CAMERA_DELAYS", part.substr(equals + 1), 0.0, 3600.0);
  }
  return delays;
}

void parse_features(const std::string& text, Script& script) {
  for (const std::string& part : split(text, ',')) {
    if (part == "no-depth") {
      script.has_depth = false;
    } else if (part == "no-colour") {
      script.has_colour = false;
    } else if (part == "no-registration") {
      script.registers = false;
    } else if (part == "no-sync") {
      script.synchronises = false;
    } else if (part == "fine-depth") {
      script.fine_depth = true;
    } else {
      throw InvalidSettings("FOOTHOLD_VIRTUAL_CAMERA_FEATURES: got '" + part +
                            "', expected no-depth, no-colour, no-registration, no-sync or fine-depth");
    }
  }
}

}  // namespace

bool Script::is_active(Event::Kind kind, std::int64_t tick) const {
  return std::any_of(events.begin(), events.end(), [&](const Event& event) {
    return event.kind == kind && tick >= event.first_tick && tick - event.first_tick < event.num_ticks;
  });
}

std::int64_t Script::jump_target(std::int64_t tick) const {
  for (const Event& event : events) {
    if (event.kind == Event::Kind::kJump && event.first_tick == tick) return event.target;
  }
  return -1;
}

std::vector<Event> parse_events(const std::string& text) {
  std::vector<Event> events;
  for (const std::string& part : split(text, ',')) events.push_back(parse_event(part));
  return events;
}

Script read_script(const std::function<const char*(const char*)>& lookup) {
  const auto value = [&](const char* name, const char* otherwise) {
    const char* text = lookup(name);
    return std::string(text != nullptr ? text : otherwise);
  };
  Script script;
  const std::string sequences = value("FOOTHOLD_VIRTUAL_CAMERA", kDefaultSequence);
  if (sequences != "none") script.sequences = split(sequences, '|');
  script.frames_per_second = parse_real("FOOTHOLD_VIRTUAL_CAMERA_FPS", value("FOOTHOLD_VIRTUAL_CAMERA_FPS", "30"), 1.0, 1000.0);
  script.at_end = parse_end(value("FOOTHOLD_VIRTUAL_CAMERA_AT_END", "hold"));
  script.events = parse_events(value("FOOTHOLD_VIRTUAL_CAMERA_EVENTS", ""));
  script.delays = parse_delays(value("FOOTHOLD_VIRTUAL_CAMERA_DELAYS", ""));
  script.lock_file = value("FOOTHOLD_VIRTUAL_CAMERA_LOCK", "");
  parse_features(value("FOOTHOLD_VIRTUAL_CAMERA_FEATURES", ""), script);
  return script;
}

int frame_at(std::int64_t playhead, int num_frames, EndOfSequence at_end) {
  const std::int64_t n = num_frames;
  if (playhead < n) return static_cast<int>(playhead);
  if (at_end == EndOfSequence::kHold || n == 1) return num_frames - 1;
  if (at_end == EndOfSequence::kRestart) return static_cast<int>(playhead % n);
  if (at_end == EndOfSequence::kUnplug) return -1;
  const std::int64_t position = playhead % (2 * n - 2);
  return static_cast<int>(position < n ? position : 2 * n - 2 - position);
}

}  // namespace foothold::virtual_camera
