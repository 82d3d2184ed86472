// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_split.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/random.h"

namespace foothold {
namespace {

enum : std::uint64_t { kCandidateStream = 200 };

constexpr int kGroup = kSplitGroup;
constexpr std::size_t kFloatSums = 256;  // examples summed in single precision before the sums are added up in double

/// Index of what is summed over examples: their number, x, y, z and the products xx xy xz yy yz zz.
enum Moment { kCount, kX, kXX = 4, kNumMoments = 10 };

using Sums = double[kNumMoments];
static_assert(sizeof(Sums) == sizeof(SceneSums::moments));

void fill_moments(const Eigen::Vector3f& p, float* moments) {
  moments[kCount] = 1.0F;
  moments[kX] = p.x();
  moments[kX + 1] = p.y();
  moments[kX + 2] = p.z();
  moments[kXX] = p.x() * p.x();
  moments[kXX + 1] = p.x() * p.y();
  moments[kXX + 2] = p.x() * p.z();
  moments[kXX + 3] = p.y() * p.y();
  moments[kXX + 4] = p.y() * p.z();
  moments[kXX + 5] = p.z() * p.z();
}

/// Sums over one scene's points.
SceneSums sum_scene(const NodeExamples& node, std::size_t begin, std::size_t end) {
  SceneSums scene;
  scene.begin = begin;
  scene.end = end;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += node.all.points_world[node.indices[i]].cast<double>();
  scene.mean_world = (sum / static_cast<double>(end - begin)).cast<float>();
  for (std::size_t i = begin; i < end; ++i) {
    float moments[kNumMoments];
    fill_moments(node.all.points_world[node.indices[i]] - scene.mean_world, moments);
    for (int m = 0; m < kNumMoments; ++m) scene.moments[m] += static_cast<double>(moments[m]);
  }
  return scene;
}

std::vector<SceneSums> sum_scenes(const NodeExamples& node) {
  std::vector<SceneSums> scenes;
  const std::vector<std::size_t>& scene_begins = node.all.scene_begins;
  std::size_t begin = 0;
  while (begin < node.indices.size()) {
    const std::size_t scene_end = *std::upper_bound(scene_begins.begin(), scene_begins.end(), std::size_t{node.indices[begin]});
    const auto* end = std::lower_bound(node.indices.begin() + begin, node.indices.end(), scene_end);
    scenes.push_back(sum_scene(node, begin, static_cast<std::size_t>(end - node.indices.begin())));
    begin = scenes.back().end;
  }
  return scenes;
}

/// Adds the scatter (sum of squared differences to the mean) of one scene's sums.
void add_scatter(const Sums& sums, double* scatter) {
  if (sums[kCount] <= 0.0) return;
  int product = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      scatter[product] += sums[kXX + product] - sums[kX + a] * sums[kX + b] / sums[kCount];
      ++product;
    }
  }
}

/// log|C + floor^2 I| of a symmetric matrix given as xx xy xz yy yz zz.
double log_determinant(const double* c, float floor_m) {
  const double floor_m2 = static_cast<double>(floor_m) * static_cast<double>(floor_m);
  const double xx = c[0] + floor_m2;
  const double yy = c[3] + floor_m2;
  const double zz = c[5] + floor_m2;
  const double determinant = xx * (yy * zz - c[4] * c[4]) - c[1] * (c[1] * zz - c[4] * c[2]) + c[2] * (c[1] * c[4] - yy * c[2]);
  return std::log(std::max(determinant, floor_m2 * floor_m2 * floor_m2));
}

/// The spatial variance V of one side. With a prior, its covariance is drawn towards the parent's, the more the fewer examples it has.
double side_variance(const double (&scatter)[6][kGroup], int candidate, double num_examples, double num_scenes, const NodeVariance& parent,
                     const ForestTrainingSettings& settings) {
  const auto prior = static_cast<double>(settings.covariance_prior_examples);
  const double divisor = prior > 0.0 ? num_examples - num_scenes + prior : num_examples;
  double covariance[6];
  for (int i = 0; i < 6; ++i) covariance[i] = (scatter[i][candidate] + prior * parent.pooled_covariance[i]) / divisor;
  return log_determinant(covariance, settings.covariance_floor_m);
}

/// The sums of a few candidates side by side.
struct GroupSums {
  double right[kNumMoments][kGroup] = {};  // of the current scene
  double scatter_right[6][kGroup] = {};    // of all scenes so far
  double scatter_left[6][kGroup] = {};
  double num_right[kGroup] = {};
  double scenes_right[kGroup] = {};
  double scenes_left[kGroup] = {};
  double pairs_right[kGroup] = {};          // of pairs that reached the node together: example right,
  double pairs_partner_right[kGroup] = {};  // partner right,
  double pairs_both_right[kGroup] = {};     // and both
};

struct Group {
  int num = 0;
  int features[kGroup] = {};
  int thresholds[kGroup] = {};
};

Group draw_candidates(const NodeExamples& node, const ForestTrainingSettings& settings, int first, int num) {
  Group group;
  group.num = num;
  for (int c = 0; c < num; ++c) {
    Random random(derive_seed(settings.seed, kCandidateStream), derive_seed(node.node_key, static_cast<std::uint64_t>(first + c)));
    const std::uint32_t feature = random.below(static_cast<std::uint32_t>(node.all.num_features));
    const std::uint32_t example = random.below(static_cast<std::uint32_t>(node.indices.size()));
    group.features[c] = static_cast<int>(feature);
    group.thresholds[c] = node.all.row(node.indices[example])[feature];
  }
  return group;
}

/// 1 for each candidate that sends a row of feature values right, else 0.
void find_sides(const Group& group, const std::int16_t* row, float* right) {
  int values[kGroup];
  for (int c = 0; c < kGroup; ++c) values[c] = row[group.features[c]];
  for (int c = 0; c < kGroup; ++c) right[c] = values[c] >= group.thresholds[c] ? 1.0F : 0.0F;
}

/// Sums the right side's moments over one scene.
void sum_right_side(const NodeExamples& node, const SceneSums& scene, const Group& group, GroupSums& sums) {
  std::fill_n(&sums.right[0][0], kNumMoments * kGroup, 0.0);
  for (std::size_t chunk = scene.begin; chunk < scene.end; chunk += kFloatSums) {
    alignas(64) float chunk_sums[kNumMoments][kGroup] = {};
    for (std::size_t i = chunk; i < std::min(scene.end, chunk + kFloatSums); ++i) {
      const std::uint32_t example = node.indices[i];
      alignas(64) float right[kGroup];
      find_sides(group, node.all.row(example), right);
      float moments[kNumMoments];
      fill_moments(node.all.points_world[example] - scene.mean_world, moments);
      for (int m = 0; m < kNumMoments; ++m) {
        for (int c = 0; c < kGroup; ++c) chunk_sums[m][c] += right[c] * moments[m];
      }
    }
    for (int m = 0; m < kNumMoments; ++m) {
      for (int c = 0; c < kGroup; ++c) sums.right[m][c] += static_cast<double>(chunk_sums[m][c]);
    }
  }
}

/// Adds the scatter of one scene's right side and of what is left to the sums of all scenes; all candidates side by side.
void finish_scene(const Sums& scene, GroupSums& sums) {
  double right_inverse[kGroup];
  double left_inverse[kGroup];
  for (int c = 0; c < kGroup; ++c) {
    const double right = sums.right[kCount][c];
    const double left = scene[kCount] - right;
    right_inverse[c] = 1.0 / std::max(right, 1.0);
    left_inverse[c] = 1.0 / std::max(left, 1.0);
    sums.num_right[c] += right;
    sums.scenes_right[c] += right > 0.0 ? 1.0 : 0.0;
    sums.scenes_left[c] += left > 0.0 ? 1.0 : 0.0;
  }
  int product = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      for (int c = 0; c < kGroup; ++c) {
        const double right_a = sums.right[kX + a][c];
        const double right_b = sums.right[kX + b][c];
        const double right_ab = sums.right[kXX + product][c];
        sums.scatter_right[product][c] += right_ab - right_a * right_b * right_inverse[c];
        const double left = scene[kXX + product] - right_ab - (scene[kX + a] - right_a) * (scene[kX + b] - right_b) * left_inverse[c];
        sums.scatter_left[product][c] += left;
      }
      ++product;
    }
  }
}

/// Counts on which sides pairs fall that have come this far together. @return Their number.
double count_pairs(const NodeExamples& node, const Group& group, GroupSums& sums) {
  double num_pairs = 0.0;
  for (std::size_t i = 0; i < node.indices.size(); ++i) {
    if (node.unparted[i] == 0) continue;
    float right[kGroup];
    float partner_right[kGroup];
    find_sides(group, node.all.row(node.indices[i]), right);
    find_sides(group, node.all.partner_row(node.indices[i]), partner_right);
    for (int c = 0; c < kGroup; ++c) {
      sums.pairs_right[c] += static_cast<double>(right[c]);
      sums.pairs_partner_right[c] += static_cast<double>(partner_right[c]);
      sums.pairs_both_right[c] += static_cast<double>(right[c] * partner_right[c]);
    }
    num_pairs += 1.0;
  }
  return num_pairs;
}

/// p log(p / q), with its limit 0 at p = 0.
double divergence_term(double p, double q) { return p > 0.0 ? p * std::log(p / q) : 0.0; }

/// The information [nat] that the sides of two views of a point share: log 2 for balanced splits on which all views agree, 0 for
/// independent ones.
double shared_information(double right, double partner_right, double both_right, double num_pairs) {
  const double r = right / num_pairs;
  const double p = partner_right / num_pairs;
  const double rr = both_right / num_pairs;
  return divergence_term(rr, r * p) + divergence_term(r - rr, r * (1.0 - p)) + divergence_term(p - rr, (1.0 - r) * p) +
         divergence_term(1.0 - r - p + rr, (1.0 - r) * (1.0 - p));
}

}  // namespace

NodeVariance node_variance(const NodeExamples& node, const ForestTrainingSettings& settings) {
  NodeVariance variance;
  variance.scenes = sum_scenes(node);
  double scatter[6] = {};
  for (const SceneSums& scene : variance.scenes) add_scatter(scene.moments, scatter);
  const auto num_scenes = static_cast<double>(variance.scenes.size());
  const auto num = static_cast<double>(node.indices.size());
  const bool has_prior = settings.covariance_prior_examples > 0.0F;
  for (int i = 0; i < 6; ++i) variance.pooled_covariance[i] = scatter[i] / (has_prior ? std::max(1.0, num - num_scenes) : num);
  variance.log_determinant = log_determinant(variance.pooled_covariance, settings.covariance_floor_m);
  return variance;
}

ScoredSplit best_split(const NodeExamples& node, const NodeVariance& variance, const ForestTrainingSettings& settings, int first, int num) {
  const Group group = draw_candidates(node, settings, first, num);
  GroupSums sums;
  for (const SceneSums& scene : variance.scenes) {
    sum_right_side(node, scene, group, sums);
    finish_scene(scene.moments, sums);
  }
  const bool with_pairs = settings.agreement_weight > 0.0F && node.all.paired;
  const double num_pairs = with_pairs ? count_pairs(node, group, sums) : 0.0;

  const auto num_examples = static_cast<double>(node.indices.size());
  const double fewest =
      std::max(static_cast<double>(settings.min_leaf_examples), static_cast<double>(settings.min_child_fraction) * num_examples);
  ScoredSplit best;
  for (int c = 0; c < num; ++c) {
    const double num_right = sums.num_right[c];
    const double num_left = num_examples - num_right;
    if (num_right < fewest || num_left < fewest) continue;
    const double right = side_variance(sums.scatter_right, c, num_right, sums.scenes_right[c], variance, settings);
    const double left = side_variance(sums.scatter_left, c, num_left, sums.scenes_left[c], variance, settings);
    const double gain = variance.log_determinant - (num_right * right + num_left * left) / num_examples;
    double score = static_cast<double>(settings.variance_weight) * gain;
    if (num_pairs > 0.0) {
      const double shared = shared_information(sums.pairs_right[c], sums.pairs_partner_right[c], sums.pairs_both_right[c], num_pairs);
      score += static_cast<double>(settings.agreement_weight) * shared * num_pairs / num_examples;
    }
    if (score > best.score) best = {{static_cast<std::uint16_t>(group.features[c]), static_cast<std::int16_t>(group.thresholds[c])}, score};
  }
  return best;
}

}  // namespace foothold
