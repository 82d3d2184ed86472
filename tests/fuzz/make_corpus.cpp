// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Writes the small good files from which fuzzing of binary formats begins:
///
///     build/ci/bin/fuzz_make_corpus tests/fuzz/corpus
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "foothold/frames/raw_sequence.h"
#include "foothold/reconstruction/reconstruction.h"
#include "forest_checkpoint.h"
#include "small_forest.h"
#include "small_fusion.h"
#include "small_keyframes.h"
#include "small_training.h"

namespace foothold::fuzz {
namespace {

class SmallSequence final : public Sequence {
 public:
  std::string name() const override { return "small"; }
  int num_frames() const override { return 2; }
  RgbdFrame load(int index) const override { return small_frame(index); }
};

class Corpus {
 public:
  explicit Corpus(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::string path(const std::string& target, const std::string& name) const {
    std::filesystem::create_directories(folder_ / target);
    return folder_ / target / name;
  }
  void write(const std::string& target, const std::string& name, const std::function<void(std::ostream&)>& save) const {
    std::ofstream stream(path(target, name), std::ios::binary);
    save(stream);
    if (!stream.flush()) throw FileError(path(target, name) + ": cannot be written");
  }
  void write(const std::string& target, const std::string& name, const Persistent& scene) const {
    write(target, name, [&](std::ostream& stream) { scene.save(stream); });
  }

 private:
  std::filesystem::path folder_;
};

void write_relocalisers(const Corpus& corpus) {
  corpus.write("forest", "good", [](std::ostream& stream) { write_forest(stream, small_forest()); });
  ForestRelocaliser forest(one_thread(), small_forest(), small_forest_settings());
  KeyframeRelocaliser keyframes(one_thread(), small_keyframe_settings());
  corpus.write("forest_scene", "good_empty", forest);
  corpus.write("keyframe_scene", "good_empty", keyframes);
  const RgbdFrame frame = small_frame(0);
  SE3 other_place = *frame.world_from_camera;
  other_place.translation.x() += 10.0F;
  for (const SE3& pose : {*frame.world_from_camera, other_place}) {
    forest.train(frame.view(), pose);
    corpus.write("forest_scene", pose.translation.x() < 1.0F ? "good" : "good_places", forest);
  }
  keyframes.train(frame.view(), *frame.world_from_camera);
  corpus.write("keyframe_scene", "good", keyframes);
}

void write_maps(const Corpus& corpus) {
  FusionPipeline pipeline(one_thread(), small_fusion_settings(), nullptr);
  corpus.write("map", "good_empty", pipeline);
  Reconstruction reconstruction(one_thread(), {small_fusion_settings(), small_forest_settings()}, small_forest());
  const RgbdFrame frame = small_frame(0);
  pipeline.start_at(*frame.world_from_camera);
  pipeline.process(frame.view());
  corpus.write("map", "good", pipeline);
  reconstruction.start_at(*frame.world_from_camera);
  reconstruction.process(frame.view());
  corpus.write("reconstruction", "good", [&](std::ostream& stream) { reconstruction.save(stream); });
}

void write_recording(const Corpus& corpus) {
  corpus.write("raw", "good", [](std::ostream& stream) {
    RawSequenceWriter writer(stream);
    for (const int index : {0, 1}) {
      RgbdFrame frame = small_frame(index);
      frame.depth = Image<float>(4, 3, 1.0F);
      frame.colour = Image<Rgb8>(4, 3);
      if (index == 1) frame.world_from_camera.reset();
      writer.write(frame);
    }
    writer.finish();
  });
}

/// One after its scenes, and one after all levels.
void write_checkpoints(const Corpus& corpus) {
  const ForestTrainingSettings settings = small_training_settings();
  const std::vector<ForestFeature> features = draw_training_features(settings);
  constexpr int kExamplesPerFrame = 8;
  ForestExampleCollector collector(one_thread(), settings, features, kExamplesPerFrame);
  ForestExamples examples = no_examples();
  ForestCheckpoint checkpoint = ForestCheckpoint::create(corpus.path("checkpoint", "good"), kTrainingName);
  for (const std::size_t scene : {0U, 1U}) {
    collector.collect(
        SmallSequence(), scene, [] { return true; }, examples);
    checkpoint.add_scene(examples);
  }
  std::filesystem::copy_file(corpus.path("checkpoint", "good"), corpus.path("checkpoint", "good_scenes"),
                             std::filesystem::copy_options::overwrite_existing);
  ForestGrower grower(one_thread(), examples, settings);
  while (!grower.is_complete()) {
    const ForestLevel level = grower.decide();
    checkpoint.add_level(level);
    grower.apply(level);
  }
}

void write_classifiers(const Corpus& corpus) {
  ClassifierModel model;
  model.name = "small";
  model.provenance = {"by hand", ""};
  model.features = {{"residual", 0.5F, 0.1F, {0.1F, -0.2F, 0.3F, 0.0F, 1.0F}}, {"inliers", -1.0F, 2.0F, {}}};
  model.good_threshold = 0.5F;
  corpus.write("classifier", "good", [&](std::ostream& stream) { write_classifier(stream, model); });
}

}  // namespace
}  // namespace foothold::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_make_corpus FOLDER\n");
    return 2;
  }
  const foothold::fuzz::Corpus corpus(argv[1]);
  foothold::fuzz::write_relocalisers(corpus);
  foothold::fuzz::write_maps(corpus);
  foothold::fuzz::write_recording(corpus);
  foothold::fuzz::write_checkpoints(corpus);
  foothold::fuzz::write_classifiers(corpus);
  return 0;
}
