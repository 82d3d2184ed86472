// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Memory that runs out in the middle of a call.
#include <functional>
#include <new>
#include <sstream>

#include "faults/failing_calls.h"
#include "foothold/reconstruction/reconstruction.h"
#include "fuzz/checked_file.h"
#include "fuzz/small_forest.h"
#include "fuzz/small_fusion.h"
#include "fuzz/small_keyframes.h"
#include "support/catch.h"
#include "support/temp_folder.h"

namespace foothold::test {
namespace {

template <class Saved>
std::string saved_bytes(const Saved& saved) {
  std::ostringstream stream;
  saved.save(stream);
  return stream.str();
}

/// What a saved reconstruction holds but for its head, which tells the time.
std::string parts_of(const Reconstruction& reconstruction) {
  const fuzz::CheckedFile file = fuzz::taken_apart(saved_bytes(reconstruction));
  std::string parts;
  for (std::size_t i = 1; i < file.data.size(); ++i) parts += file.data[i].contents;
  return parts;
}

template <class Kind>
void teach(Kind& relocaliser, int num_frames) {
  for (int i = 0; i < num_frames; ++i) {
    const RgbdFrame frame = fuzz::small_frame(i);
    relocaliser.train(frame.view(), *frame.world_from_camera);
  }
}

ForestRelocaliser small_forest_relocaliser() {
  return ForestRelocaliser(fuzz::one_thread(), fuzz::small_forest(), fuzz::small_forest_settings());
}

/// Of one frame.
Reconstruction small_reconstruction(int index) {
  Reconstruction reconstruction(fuzz::one_thread(), {fuzz::small_fusion_settings(), fuzz::small_forest_settings()}, fuzz::small_forest());
  const RgbdFrame frame = fuzz::small_frame(index);
  reconstruction.start_at(*frame.world_from_camera);
  reconstruction.process(frame.view());
  return reconstruction;
}

/// Calls again and again, until no allocation of `call` is left to fail.
/// @param check  Called after each failure.
void fail_every_allocation(const std::function<void()>& call, const std::function<void()>& check) {
  int number = 0;
  for (bool has_failed = true; has_failed; ++number) {
    INFO("allocation " << number);
    bool has_thrown = false;
    {
      const FailingCall fault(CallKind::kAllocation, number);
      try {
        call();
      } catch (const std::bad_alloc&) {
        has_thrown = true;
      } catch (const FileError&) {  // a stream that could not go on
        has_thrown = true;
      }
      has_failed = fault.has_failed();
    }
    CHECK((has_failed || !has_thrown));
    if (has_thrown) check();
  }
  CHECK(number > 1);
}

/// Loads bytes, every allocation failing in turn: what `state` tells stays as it was until loading succeeds.
template <class Load, class State>
void check_former_stays(const std::string& bytes, const Load& load, const State& state) {
  const std::string former = state();
  std::istringstream stream;
  fail_every_allocation(
      [&] {
        stream.clear();
        stream.str(bytes);
        load(stream);
      },
      [&] { REQUIRE((state() == former)); });
  CHECK((state() != former));
}

}  // namespace

TEST_CASE("ForestRelocaliser::load: the former scene stays whichever allocation fails") {
  ForestRelocaliser other = small_forest_relocaliser();
  teach(other, 3);
  const std::string loaded = saved_bytes(other);
  ForestRelocaliser relocaliser = small_forest_relocaliser();
  teach(relocaliser, 1);
  check_former_stays(
      loaded, [&](std::istream& stream) { relocaliser.load(stream); }, [&] { return saved_bytes(relocaliser); });
  CHECK((saved_bytes(relocaliser) == loaded));
}

TEST_CASE("ForestRelocaliser::save: the scene stays whichever allocation fails") {
  ForestRelocaliser relocaliser = small_forest_relocaliser();
  teach(relocaliser, 2);
  const std::string before = saved_bytes(relocaliser);
  fail_every_allocation([&] { saved_bytes(relocaliser); }, [&] { REQUIRE((saved_bytes(relocaliser) == before)); });
}

TEST_CASE("ForestRelocaliser: goes on after an allocation that failed, and what it saves is a scene") {
  const RgbdFrame frame = fuzz::small_frame(2);
  ForestRelocaliser taught = small_forest_relocaliser();
  teach(taught, 2);
  ForestRelocaliser relocaliser = taught;
  const auto check = [&] {
    fuzz::use(relocaliser);
    ForestRelocaliser again = small_forest_relocaliser();
    std::istringstream stream(saved_bytes(relocaliser));
    again.load(stream);
    relocaliser = taught;
  };
  fail_every_allocation([&] { relocaliser.train(frame.view(), *frame.world_from_camera); }, check);
  fail_every_allocation([&] { relocaliser.relocalise(frame.view()); }, check);
}

TEST_CASE("KeyframeRelocaliser: load and train change nothing whichever allocation fails") {
  KeyframeRelocaliserSettings settings = fuzz::small_keyframe_settings();
  settings.harvest_dissimilarity = 0.0F;
  KeyframeRelocaliser other(fuzz::one_thread(), settings);
  teach(other, 3);
  const std::string loaded = saved_bytes(other);
  KeyframeRelocaliser relocaliser(fuzz::one_thread(), settings);
  teach(relocaliser, 1);
  KeyframeRelocaliser copy = relocaliser;
  check_former_stays(
      loaded, [&](std::istream& stream) { copy.load(stream); }, [&] { return saved_bytes(copy); });
  CHECK((saved_bytes(copy) == loaded));
  const std::string former = saved_bytes(relocaliser);
  const RgbdFrame frame = fuzz::small_frame(9);
  fail_every_allocation([&] { relocaliser.train(frame.view(), *frame.world_from_camera); },
                        [&] { REQUIRE((saved_bytes(relocaliser) == former)); });
  CHECK(relocaliser.num_keyframes() == 2);
}

TEST_CASE("Reconstruction::load: the former scene stays whichever allocation fails") {
  const std::string loaded = saved_bytes(small_reconstruction(5));
  Reconstruction reconstruction = small_reconstruction(0);
  check_former_stays(
      loaded, [&](std::istream& stream) { reconstruction.load(stream, "a.scene"); }, [&] { return parts_of(reconstruction); });
}

TEST_CASE("FusionPipeline::load: the former map stays whichever allocation fails") {
  const auto pipeline_from = [](int first) {
    FusionPipeline pipeline(fuzz::one_thread(), fuzz::small_fusion_settings(), nullptr);
    pipeline.start_at(*fuzz::small_frame(first).world_from_camera);
    pipeline.process(fuzz::small_frame(first).view());
    return pipeline;
  };
  const std::string loaded = saved_bytes(pipeline_from(2));
  FusionPipeline pipeline = pipeline_from(0);
  check_former_stays(
      loaded, [&](std::istream& stream) { pipeline.load(stream); }, [&] { return saved_bytes(pipeline); });
  CHECK((saved_bytes(pipeline) == loaded));
}

TEST_CASE("load_settings: none is changed whichever allocation fails") {
  const TempFolder temp;
  FusionSettings other;
  other.render_divisor = 2;
  other.volume.max_blocks = 77;
  save_settings(temp / "a.json", other);
  FusionSettings settings;
  const std::string former = settings_to_json(describe_settings(settings));
  fail_every_allocation([&] { load_settings(temp / "a.json", settings); },
                        [&] { REQUIRE(settings_to_json(describe_settings(settings)) == former); });
  CHECK(settings.volume.max_blocks == 77);
}

}  // namespace foothold::test
