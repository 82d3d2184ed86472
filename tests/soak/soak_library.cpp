// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Trains relocalisers on a plain wall, whose every pixel falls into one leaf, with that leaf's counter set near its limits: what 24 hours
/// before a wall come to. scripts/soak.sh runs it and watches its memory.
///
///     soak_library FRAMES SECONDS
///
/// Trains FRAMES frames from each start, again and again until SECONDS have passed, and prints the frames so far. Exit status 1 if a
/// counter wrapped.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "fuzz/checked_file.h"

namespace foothold::soak {
namespace {

/// 1200 examples a frame.
RgbdFrame plain_wall() {
  RgbdFrame frame;
  frame.calibration.depth = frame.calibration.colour = {40.0F, 40.0F, 19.5F, 14.5F};
  frame.depth = Image<float>(40, 30, 1.0F);
  frame.colour = Image<Rgb8>(40, 30, Rgb8{200, 200, 200});
  return frame;
}

/// @param examples_per_view  0: every frame is learnt whole, as before the scene's memory had places.
ForestRelocaliser relocaliser_of(int examples_per_view) {
  ContextOptions options;
  options.num_threads = 1;
  RandomForestSettings forest;
  forest.num_trees = 1;
  forest.depth = 4;
  ForestRelocaliserSettings settings;
  settings.reservoirs.examples_per_view = examples_per_view;
  settings.reservoirs.capacity = 64;
  settings.pose.pool_size = 500;
  settings.pose.num_hypotheses = 16;
  return ForestRelocaliser(Context(options), make_random_forest(forest), settings);
}

std::string saved(const ForestRelocaliser& relocaliser) {
  std::ostringstream stream;
  relocaliser.save(stream);
  return stream.str();
}

/// The points that each leaf of the first place was offered, inside the contents of a saved scene: docs/scene-format.md.
struct Counters {
  explicit Counters(const std::string& contents) {
    constexpr std::size_t kBeforeLearntViews = 8 + 4 + 4 + 8 + 8 + 3 * 4;  // forest, capacity, modes, frames, places, origin
    const std::size_t num_views = count_at(contents, kBeforeLearntViews + 8);
    const std::size_t count = kBeforeLearntViews + 16 + 8 * num_views;
    place = count + 8;
    num_leaves = count_at(contents, count);
  }
  static std::size_t count_at(const std::string& contents, std::size_t at) {
    std::uint64_t count = 0;
    std::memcpy(&count, &contents.at(at), sizeof(count));
    return static_cast<std::size_t>(count);
  }
  std::uint32_t largest(const std::string& contents) const {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < num_leaves; ++i) {
      std::uint32_t value = 0;
      std::memcpy(&value, &contents.at(place + 4 * i), sizeof(value));
      result = std::max(result, value);
    }
    return result;
  }

  std::size_t place = 0;
  std::size_t num_leaves = 0;
};

std::uint32_t largest_counter(const ForestRelocaliser& relocaliser) {
  const std::string contents = fuzz::taken_apart(saved(relocaliser)).data.at(0).contents;
  return Counters(contents).largest(contents);
}

/// Sets the counters that are not zero.
void set_counters(ForestRelocaliser& relocaliser, std::uint32_t value) {
  fuzz::CheckedFile file = fuzz::taken_apart(saved(relocaliser));
  std::string& contents = file.data.at(0).contents;
  const Counters counters(contents);
  for (std::size_t i = 0; i < counters.num_leaves; ++i) {
    char* counter = &contents.at(counters.place + 4 * i);
    if (std::any_of(counter, counter + 4, [](char byte) { return byte != 0; })) std::memcpy(counter, &value, sizeof(value));
  }
  std::istringstream stream(fuzz::put_together(file, fuzz::Chain::kNone));
  relocaliser.load(stream);
}

class Loop {
 public:
  Loop(long num_frames, double num_seconds) : num_frames_(num_frames), num_seconds_(num_seconds) {}

  /// @return False if a counter wrapped.
  bool run() {
    // Half of the frames before the limit, half behind it.
    const auto reach = static_cast<std::uint32_t>(std::min(600L * num_frames_, 1L << 30U));
    const std::uint32_t starts[] = {2000, (std::uint32_t{1} << 31U) - reach, ~std::uint32_t{0} - reach};
    do {
      for (const std::uint32_t start : starts) {
        if (!train_from(start)) return false;
      }
    } while (seconds() < num_seconds_);
    return true;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

  bool train_from(std::uint32_t start) {
    constexpr int kUpkeepEvery = 1000;
    ForestRelocaliser whole = relocaliser_of(0);
    ForestRelocaliser by_views = relocaliser_of(32);
    for (ForestRelocaliser* relocaliser : {&whole, &by_views}) {
      for (int i = 0; i < 4; ++i) relocaliser->train(wall_.view(), SE3{});
      set_counters(*relocaliser, start);
    }
    for (long i = 1; i <= num_frames_; ++i, ++num_done_) {
      for (ForestRelocaliser* relocaliser : {&whole, &by_views}) {
        relocaliser->train(wall_.view(), SE3{});
        if (i % kUpkeepEvery == 0) keep_up(*relocaliser);
      }
      if (i % kUpkeepEvery == 0) {
        std::printf("frames %ld\n", num_done_);
        std::fflush(stdout);
      }
    }
    const std::uint32_t end = largest_counter(whole);
    std::printf("from %u to %u\n", start, end);
    return end > start && largest_counter(by_views) >= start;
  }

  void keep_up(ForestRelocaliser& relocaliser) const {
    relocaliser.update();
    relocaliser.relocalise(wall_.view());
    std::istringstream stream(saved(relocaliser));
    relocaliser.load(stream);
  }

  long num_frames_;
  double num_seconds_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  RgbdFrame wall_ = plain_wall();
  long num_done_ = 0;
};

}  // namespace
}  // namespace foothold::soak

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: soak_library FRAMES SECONDS\n");
    return 2;
  }
  if (foothold::soak::Loop(std::atol(argv[1]), std::atof(argv[2])).run()) return 0;
  std::fprintf(stderr, "soak_library: a counter wrapped\n");
  return 1;
}
