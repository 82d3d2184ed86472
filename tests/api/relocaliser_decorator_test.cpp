// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/relocaliser_decorator.h"

#include <string>

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Writes down what it is called with.
class Recorder final : public Relocaliser {
 public:
  explicit Recorder(std::string& calls) : calls_(calls) {}
  ~Recorder() override { calls_ += "~"; }

  void train(const Frame& frame, const SE3& world_from_camera) override {
    calls_ += "train " + std::to_string(frame.index) + " at " + std::to_string(static_cast<int>(world_from_camera.translation.x())) + ";";
  }
  std::vector<PoseEstimate> relocalise(const Frame& frame) override {
    calls_ += "relocalise " + std::to_string(frame.index) + ";";
    return {{SE3{}, 0.75F}};
  }
  void update() override { calls_ += "update;"; }
  void reset() override { calls_ += "reset;"; }
  std::size_t state_bytes() const override { return 123; }
  float acceptance_threshold() const override { return 0.25F; }

 private:
  std::string& calls_;
};

/// Overrides one call.
class Sceptic final : public RelocaliserDecorator {
 public:
  using RelocaliserDecorator::RelocaliserDecorator;
  float acceptance_threshold() const override { return 2.0F * inner().acceptance_threshold(); }
};

Frame frame_of_index(int index) {
  Frame frame;
  frame.index = index;
  return frame;
}

/// Makes every call once.
void call_all(Relocaliser& relocaliser) {
  SE3 pose;
  pose.translation.x() = 7.0F;
  relocaliser.train(frame_of_index(1), pose);
  const std::vector<PoseEstimate> estimates = relocaliser.relocalise(frame_of_index(2));
  REQUIRE(estimates.size() == 1);
  REQUIRE(estimates.front().confidence == 0.75F);
  relocaliser.update();
  relocaliser.reset();
  REQUIRE(relocaliser.state_bytes() == 123);
}

TEST_CASE("RelocaliserDecorator: hands every call on as it is, and what is overridden differs") {
  std::string calls;
  Recorder recorder(calls);
  RelocaliserDecorator plain(recorder);
  call_all(plain);
  REQUIRE(calls == "train 1 at 7;relocalise 2;update;reset;");
  REQUIRE(plain.acceptance_threshold() == 0.25F);
  REQUIRE(Sceptic(recorder).acceptance_threshold() == 0.5F);
}

TEST_CASE("RelocaliserDecorator: owns what it is given as a unique_ptr, and refuses none") {
  std::string calls;
  {
    Sceptic owner(std::make_unique<Recorder>(calls));
    call_all(owner);
  }
  REQUIRE(calls == "train 1 at 7;relocalise 2;update;reset;~");
  REQUIRE_THROWS_AS(RelocaliserDecorator(std::unique_ptr<Relocaliser>()), ContractViolation);
}

}  // namespace
}  // namespace foothold
