// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/background_relocaliser.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <stdexcept>
#include <string>

#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Writes down what it is called with, the images' first and last pixels included.
class Pupil final : public Relocaliser {
 public:
  void train(const Frame& frame, const SE3& world_from_camera) override {
    if (before_training) before_training();
    const int right = frame.depth.width - 1;
    const int bottom = frame.depth.height - 1;
    calls += "train " + std::to_string(frame.index) + " " + std::to_string(frame.depth(0, 0)) + " " +
             std::to_string(frame.depth(right, bottom)) + " " + std::to_string(frame.colour(0, 0).r) + " " +
             std::to_string(frame.colour(right, bottom).b) + " at " + std::to_string(world_from_camera.translation.x()) + ";";
    depth_m = frame.depth.data;
  }
  std::vector<PoseEstimate> relocalise(const Frame& frame) override {
    calls += "relocalise " + std::to_string(frame.index) + ";";
    return {{SE3{}, 0.75F}};
  }
  void update() override { calls += "update;"; }
  void reset() override { calls += "reset;"; }
  std::size_t state_bytes() const override { return calls.size(); }
  float acceptance_threshold() const override { return 0.25F + static_cast<float>(calls.size()); }

  std::string calls;
  std::function<void()> before_training;
  const float* depth_m = nullptr;  ///< of the last frame
};

Context threads(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}

/// A frame of 5 x 3 pixels of one colour and depth, 3 or 4 bytes a pixel.
struct SmallFrame {
  explicit SmallFrame(int index, int bytes_per_pixel = 3) {
    fill(index);
    const ImageView<const float> depth{depth_m.data(), 5, 3, MemoryKind::kHost};
    const ColourView seen{colour.data(), 5, 3, bytes_per_pixel, MemoryKind::kHost};
    const Intrinsics intrinsics{5.0F, 5.0F, 2.0F, 1.0F};
    frame = {depth, seen, {intrinsics, intrinsics, SE3{}}, index, 0.0};
  }
  SmallFrame(const SmallFrame&) = delete;

  void fill(int value) {
    std::fill(depth_m.begin(), depth_m.end(), static_cast<float>(value));
    std::fill(colour.begin(), colour.end(), static_cast<std::uint8_t>(value));
  }

  std::vector<float> depth_m = std::vector<float>(15);
  std::vector<std::uint8_t> colour = std::vector<std::uint8_t>(60);
  Frame frame;
};

SE3 at(float x) {
  SE3 pose;
  pose.translation.x() = x;
  return pose;
}

/// Makes call number `kind` of some, and says what it returned.
std::string call(Relocaliser& relocaliser, std::uint32_t kind, int index) {
  SmallFrame small(index, index % 2 == 0 ? 3 : 4);
  if (kind == 0) return std::to_string(relocaliser.relocalise(small.frame).front().confidence);
  if (kind == 1) return std::to_string(relocaliser.state_bytes());
  if (kind == 2) return std::to_string(relocaliser.acceptance_threshold());
  if (kind == 3) relocaliser.reset();
  if (kind == 4) relocaliser.update();
  if (kind > 4) {
    relocaliser.train(small.frame, at(static_cast<float>(index)));
    small.fill(0);  // the images are the host's again
    relocaliser.update();
  }
  return {};
}

TEST_CASE("BackgroundRelocaliser: whatever the order of calls, the wrapped one sees them so, and answers as by itself") {
  Random random = test::test_random();
  for (const int num_threads : {1, 2, 4}) {
    Pupil alone;
    Pupil wrapped;
    BackgroundRelocaliser background(threads(num_threads), wrapped);
    for (int i = 0; i < 300; ++i) {
      const std::uint32_t kind = random.below(12);
      REQUIRE(call(background, kind, i % 200) == call(alone, kind, i % 200));
    }
    background.wait();
    REQUIRE(wrapped.calls == alone.calls);
  }
}

TEST_CASE("BackgroundRelocaliser: training goes on behind the call, and with one thread it does not") {
  Pupil wrapped;
  SmallFrame small(1);
  {
    BackgroundRelocaliser background(threads(2), wrapped);
    std::promise<void> returned;
    wrapped.before_training = [&] { returned.get_future().wait(); };
    background.train(small.frame, at(0.0F));
    background.update();
    returned.set_value();  // never reached if these had waited
    background.wait();
    REQUIRE(wrapped.calls.find("train 1") == 0);
    REQUIRE(wrapped.calls.find("update;") != std::string::npos);
    REQUIRE(wrapped.depth_m != small.depth_m.data());
  }
  wrapped.before_training = nullptr;
  BackgroundRelocaliser background(threads(1), wrapped);
  background.train(small.frame, at(0.0F));
  REQUIRE(wrapped.depth_m == small.depth_m.data());
}

TEST_CASE("BackgroundRelocaliser: what training throws is thrown by the next call, whichever it is, once") {
  const std::function<void(Relocaliser&)> next_calls[] = {
      [](Relocaliser& relocaliser) { relocaliser.train(SmallFrame(2).frame, at(0.0F)); },
      [](Relocaliser& relocaliser) { relocaliser.relocalise(SmallFrame(2).frame); },
      [](Relocaliser& relocaliser) { relocaliser.reset(); },
      [](Relocaliser& relocaliser) { relocaliser.state_bytes(); },
      [](Relocaliser& relocaliser) { relocaliser.acceptance_threshold(); },
      [](Relocaliser& relocaliser) { static_cast<const BackgroundRelocaliser&>(relocaliser).wait(); },
  };
  for (const auto& next_call : next_calls) {
    Pupil wrapped;
    BackgroundRelocaliser background(threads(2), wrapped);
    std::promise<void> returned;
    wrapped.before_training = [&] {
      returned.get_future().wait();
      throw std::runtime_error("out of memory");
    };
    background.train(SmallFrame(1).frame, at(0.0F));
    background.update();
    returned.set_value();
    REQUIRE(test::error_of<std::runtime_error>([&] { next_call(background); }) == "out of memory");
    REQUIRE(wrapped.calls.empty());  // as if update() had not been reached
    wrapped.before_training = nullptr;
    REQUIRE_NOTHROW(next_call(background));
    background.wait();
  }
}

TEST_CASE("BackgroundRelocaliser: malformed frames and poses are refused at once") {
  Pupil wrapped;
  BackgroundRelocaliser background(threads(2), wrapped);
  SmallFrame small(1);
  SE3 mirror;
  mirror.rotation(0, 0) = -1.0F;
  REQUIRE_THROWS_AS(background.train(Frame{}, at(0.0F)), ContractViolation);
  REQUIRE_THROWS_AS(background.train(small.frame, mirror), ContractViolation);
  background.wait();
  REQUIRE(wrapped.calls.empty());
}

TEST_CASE("BackgroundRelocaliser: destruction waits for training") {
  test::LoggedWarnings log;
  Pupil wrapped;
  {
    BackgroundRelocaliser background(log.context(), wrapped);
    background.train(SmallFrame(1).frame, at(0.0F));
    background.update();
  }
  REQUIRE(wrapped.calls.size() > std::string("update;").size());
  REQUIRE(wrapped.calls.substr(wrapped.calls.size() - 7) == "update;");
  REQUIRE(log.warnings.empty());
}

}  // namespace
}  // namespace foothold
