// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Reconstructions whose relocaliser learns beside tracking: they do what those do whose relocaliser learns in between.
#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "foothold/base/checked_stream.h"
#include "fuzz/checked_file.h"
#include "reconstruction/small_kitchen.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using namespace test;

/// What a saved scene holds but for its head, which tells the time.
std::string parts_of(const Reconstruction& reconstruction) {
  std::ostringstream stream;
  reconstruction.save(stream);
  const fuzz::CheckedFile file = fuzz::taken_apart(stream.str());
  std::string parts;
  for (std::size_t i = 1; i < file.data.size(); ++i) parts += file.data[i].contents;
  return parts;
}

bool same(const FusionFrameResult& a, const FusionFrameResult& b) {
  if (a.state != b.state || a.world_from_camera.has_value() != b.world_from_camera.has_value()) return false;
  if (a.confidence != b.confidence || a.quality_score != b.quality_score || a.agreement.agreement != b.agreement.agreement) return false;
  if (a.fused != b.fused || a.trained != b.trained || a.relocalised != b.relocalised || a.relocaliser_asked != b.relocaliser_asked)
    return false;
  return !a.world_from_camera.has_value() || (a.world_from_camera->rotation == b.world_from_camera->rotation &&
                                              a.world_from_camera->translation == b.world_from_camera->translation);
}

/// Learns slowly, remembers how much, and fails when told to.
class SlowPupil final : public Relocaliser, public Persistent {
 public:
  void train(const Frame&, const SE3&) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    if (static_cast<int>(num_learnt) == fails_at) {
      fails_at = -1;
      throw std::runtime_error("forgot everything");
    }
    ++num_learnt;
  }
  std::vector<PoseEstimate> relocalise(const Frame&) override { return {}; }
  void update() override { ++num_updates; }
  void reset() override { num_learnt = num_updates = 0; }
  std::size_t state_bytes() const override { return 1000 * num_learnt + num_updates; }
  float acceptance_threshold() const override { return 0.5F; }
  void save(std::ostream& stream) const override {
    CheckedWriter writer(stream, kFormat);
    writer.write(num_learnt);
    writer.finish();
  }
  void load(std::istream& stream) override {
    CheckedReader reader(stream, kFormat);
    num_learnt = reader.read<std::uint32_t>("frames");
    reader.finish();
  }

  std::uint32_t num_learnt = 0;
  std::uint32_t num_updates = 0;
  int fails_at = -1;

 private:
  static constexpr BinaryFormat kFormat{"pupil", "FHPUPIL\n", 1};
};

Reconstruction with_pupil(const Context& context, int fails_at = -1) {
  SlowPupil pupil;
  pupil.fails_at = fails_at;
  return {context, small_settings().fusion, pupil};
}

}  // namespace

TEST_CASE("Reconstruction: learning beside tracking changes neither a result nor a bit of the saved scene") {
  Reconstruction beside(two_threads(), small_settings(), small_forest());
  Reconstruction between(threads(1), small_settings(), small_forest());
  bool relocalised = false;
  for (std::size_t i = 0; i < 2 * kitchen().size(); ++i) {
    if (i % 25 == 24) {
      beside.force_loss();
      between.force_loss();
    }
    const Frame frame = kitchen()[i % kitchen().size()].view();  // jumps back from the last
    const FusionFrameResult result = beside.process(frame);
    INFO("frame " << i);
    REQUIRE(same(result, between.process(frame)));
    relocalised = relocalised || result.relocalised;
    if (i % 20 == 0) REQUIRE((parts_of(beside) == parts_of(between)));
  }
  CHECK(relocalised);
  REQUIRE((parts_of(beside) == parts_of(between)));
}

TEST_CASE("Reconstruction: whatever looks at the relocaliser waits until it has learnt the last frame") {
  Reconstruction reconstruction = with_pupil(two_threads());
  walk(reconstruction, 3);
  CHECK(reconstruction.relocaliser_bytes() == 3003);
  walk(reconstruction, 1);
  const Reconstruction copy(reconstruction);
  CHECK(copy.relocaliser_bytes() == 4004);
  walk(reconstruction, 1);
  std::stringstream stream;
  reconstruction.save(stream);
  Reconstruction loaded = with_pupil(two_threads());
  walk(loaded, 2);
  loaded.load(stream, "a stream");
  CHECK(loaded.relocaliser_bytes() == 5000);
  walk(reconstruction, 1);
  reconstruction.reset();
  CHECK(reconstruction.relocaliser_bytes() == 0);
}

TEST_CASE("Reconstruction: what learning throws reaches the caller of a later call, and the reconstruction goes on") {
  Reconstruction reconstruction = with_pupil(two_threads(), 2);
  walk(reconstruction, 2);
  CHECK_NOTHROW(reconstruction.process(kitchen()[2].view()));  // learnt behind the call
  CHECK(error_of<std::runtime_error>([&] { reconstruction.process(kitchen()[3].view()); }) == "forgot everything");
  CHECK(reconstruction.process(kitchen()[4].view()).trained);
  CHECK(reconstruction.relocaliser_bytes() == 3003);
  Reconstruction saved = with_pupil(two_threads(), 0);
  walk(saved, 1);
  std::stringstream stream;
  CHECK(error_of<std::runtime_error>([&] { saved.save(stream); }) == "forgot everything");
  CHECK_NOTHROW(saved.save(stream));
}

TEST_CASE("Reconstruction: it may be destroyed or replaced while its relocaliser learns") {
  LoggedWarnings log;
  for (const int fails_at : {-1, 0}) {
    Reconstruction reconstruction = with_pupil(log.context(), fails_at);
    walk(reconstruction, 1);
    reconstruction = with_pupil(log.context());
    walk(reconstruction, 1);
    Reconstruction moved(std::move(reconstruction));
    CHECK(moved.relocaliser_bytes() == 1001);
    walk(moved, 1);
  }
  REQUIRE(log.warnings.size() == 1);
  CHECK(contains(log.warnings.front(), "forgot everything"));
}

}  // namespace foothold
