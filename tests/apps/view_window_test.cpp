// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_window.h"

#include <cstdlib>
#include <map>
#include <optional>

#include "common/display_probe.h"
#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold::apps {
namespace {

using Catch::Matchers::Contains;

/// Sets environment variables (nullptr: unsets) and puts them back.
class Environment {
 public:
  explicit Environment(const std::map<std::string, const char*>& variables) {
    for (const auto& [name, value] : variables) {
      const char* before = std::getenv(name.c_str());
      before_[name] = before == nullptr ? std::nullopt : std::optional<std::string>(before);
      set(name, value);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_) set(name, value.has_value() ? value->c_str() : nullptr);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  static void set(const std::string& name, const char* value) {
    if (value == nullptr) {
      ::unsetenv(name.c_str());
    } else {
      ::setenv(name.c_str(), value, 1);
    }
  }
  std::map<std::string, std::optional<std::string>> before_;
};

}  // namespace

TEST_CASE("ViewWindow: without a display it says so instead of ending the process") {
  const Environment environment({{"DISPLAY", nullptr}, {"WAYLAND_DISPLAY", nullptr}, {"QT_QPA_PLATFORM", nullptr}});
  CHECK_THAT(describe_missing_display(), Contains("neither DISPLAY nor WAYLAND_DISPLAY"));
  CHECK_THROWS_AS(ViewWindow("test"), DeviceError);
}

TEST_CASE("ViewWindow: whatever way a display is unusable in, it is named in one line") {
  struct Case {
    const char* display;
    const char* wayland;
    const char* platform;
    const char* says;
  };
  const Case c = GENERATE(values<Case>({{":9876.0", nullptr, nullptr, ":9876.0"},
                                        {"localhost:9876.0", nullptr, nullptr, "localhost:9876.0"},  // a dead forwarding
                                        {"unix:9876", nullptr, nullptr, "unix:9876"},
                                        {"no such host.invalid:0", nullptr, nullptr, "no such host"},
                                        {nullptr, "wayland-9876", nullptr, "wayland-9876"},
                                        {nullptr, nullptr, "no-such-platform", "no-such-platform"}}));
  const Environment environment({{"DISPLAY", c.display}, {"WAYLAND_DISPLAY", c.wayland}, {"QT_QPA_PLATFORM", c.platform}});
  const std::string missing = describe_missing_display();
  CHECK_THAT(missing, Contains(c.says));
  CHECK(missing.find('\n') == std::string::npos);
  CHECK_THROWS_AS(ViewWindow("test"), DeviceError);
}

TEST_CASE("describe_missing_display: says nothing where a window can be opened") {
  const Environment environment({{"DISPLAY", nullptr}, {"WAYLAND_DISPLAY", nullptr}, {"QT_QPA_PLATFORM", "offscreen"}});
  CHECK(describe_missing_display().empty());
}

}  // namespace foothold::apps
