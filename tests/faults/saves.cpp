// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "faults/saves.h"

#include <filesystem>
#include <memory>

#include "foothold/base/atomic_file.h"
#include "foothold/files/scene_file.h"
#include "foothold/frames/raw_sequence.h"
#include "foothold/io/mesh_file.h"
#include "foothold/io/seven_scenes_writer.h"
#include "foothold/io/trajectory.h"
#include "fuzz/small_forest.h"
#include "support/temp_folder.h"

namespace foothold::test {
namespace {

/// A part of a scene that takes several writes.
struct LargePart final : Persistent {
  explicit LargePart(char letter) : bytes(300000, letter) {}
  void save(std::ostream& stream) const override { stream << bytes; }
  void load(std::istream& /*stream*/) override {}
  std::string bytes;
};

Mesh triangles(float size_m, std::size_t count) {
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<int>(mesh.vertices.size());
    const float x = static_cast<float>(i);
    for (const auto& corner : {Eigen::Vector3f(x, 0, 0), Eigen::Vector3f(x + size_m, 0, 0), Eigen::Vector3f(x, size_m, 0)}) {
      mesh.vertices.push_back(corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A file that `save(path, is_new)` replaces.
SaveCase file_case(const std::string& name, const std::function<void(const std::string& path, bool is_new)>& save) {
  return {name, [save](const std::string& folder) {
            const std::string path = folder + "/saved";
            save(path, false);
            return [save, path] { save(path, true); };
          }};
}

std::function<void()> prepare_recording(const std::string& folder) {
  const auto writer = std::make_shared<SevenScenesWriter>(folder + "/recording");
  writer->write(fuzz::small_frame(0));
  return [writer] { writer->write(fuzz::small_frame(writer->num_frames())); };
}

void write_raw_recording(const std::string& path, bool is_new) {
  write_file_atomically(path, [&](std::ostream& stream) {
    RawSequenceWriter writer(stream);
    for (int i = is_new ? 0 : 20; i < 40; ++i) writer.write(fuzz::small_frame(i));
    writer.finish();
  });
}

}  // namespace

std::vector<SaveCase> all_saves() {
  return {
      file_case("forest",
                [](const std::string& path, bool is_new) {
                  RandomForestSettings settings;
                  settings.depth = is_new ? 12 : 8;
                  save_forest(path, make_random_forest(settings));
                }),
      file_case("scene",
                [](const std::string& path, bool is_new) {
                  const LargePart part(is_new ? 'n' : 'o');
                  save_scene(path, {{{"setting", is_new ? "new" : "old"}}, {}}, {{"part", &part}});
                }),
      file_case("settings",
                [](const std::string& path, bool is_new) {
                  ForestRelocaliserSettings settings;
                  if (is_new) settings.reservoirs.capacity = 17;
                  save_settings(path, settings);
                }),
      file_case("mesh", [](const std::string& path, bool is_new) { write_ply(path, triangles(0.5F, is_new ? 5000 : 4000)); }),
      file_case("trajectory",
                [](const std::string& path, bool is_new) { write_trajectory(path, std::vector<StampedPose>(is_new ? 3000 : 2000)); }),
      file_case("raw recording", write_raw_recording),
      {"recording", prepare_recording, false},
  };
}

FolderContents contents_of(const std::string& folder) {
  FolderContents contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) contents[std::filesystem::relative(entry.path(), folder)] = read_text(entry.path());
  }
  return contents;
}

SaveStates undisturbed(const SaveCase& save_case) {
  const TempFolder temp;
  const std::function<void()> save = save_case.prepare(temp.path());
  SaveStates states;
  states.before = contents_of(temp.path());
  save();
  states.after = contents_of(temp.path());
  return states;
}

}  // namespace foothold::test
