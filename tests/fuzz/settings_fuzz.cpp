// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Settings files: what is accepted is in range, and survives being written and read again.
#include "foothold/synthetic/synthetic_sequence.h"
#include "fuzz.h"
#include "settings_json.h"

namespace {

/// Settings of every kind of field, nested once.
struct OuterSettings {
  foothold::SyntheticSequenceSettings room;
  bool fast = false;
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&OuterSettings::room, "room");
    v(&OuterSettings::fast, "fast", "A switch.");
  }
};

void assign_all(const std::string& text, OuterSettings& settings) {
  for (const foothold::SettingText& setting : foothold::files::parse_settings_json(text, "settings.json")) {
    foothold::assign_setting(settings, setting.path, setting.text);
  }
}

}  // namespace

FOOTHOLD_FUZZ_TARGET(settings) {
  using namespace foothold;
  const std::string text = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    OuterSettings settings;
    assign_all(text, settings);
    validate_settings(settings);
    const std::string json = settings_to_json(describe_settings(settings));
    OuterSettings again;
    assign_all(json, again);
    fuzz::require(settings_to_json(describe_settings(again)) == json);
  });
  return 0;
}
