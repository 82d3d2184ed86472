// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Alignment of a depth image with a rendered surface: sums over pixels, and the step that follows from them.
#pragma once

#include <algorithm>
#include <cmath>

#include "icp_ops.h"
#include "small_cholesky.h"

namespace foothold {

/// Averages the depths of 2 x 2 pixels that lie on the nearest one's surface.
struct HalveDepth {
  ImageView<const float> fine;
  float min_depth_m;
  float max_depth_m;
  float* coarse;
  int coarse_width;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    constexpr float kSameSurface = 0.03F;  // of the depth
    const int u = static_cast<int>(i) % coarse_width * 2;
    const int v = static_cast<int>(i) / coarse_width * 2;
    const float depths_m[4] = {fine(u, v), fine(u + 1, v), fine(u, v + 1), fine(u + 1, v + 1)};
    float nearest_m = max_depth_m + 1.0F;
    for (const float depth_m : depths_m) nearest_m = depth_m >= min_depth_m && depth_m < nearest_m ? depth_m : nearest_m;
    float sum = 0.0F;
    float count = 0.0F;
    for (const float depth_m : depths_m) {
      const bool same = depth_m >= nearest_m && depth_m <= nearest_m * (1.0F + kSameSurface);
      sum += same ? depth_m : 0.0F;
      count += same ? 1.0F : 0.0F;
    }
    coarse[i] = nearest_m <= max_depth_m ? sum / count : 0.0F;
  }
};

/// Counts the pixels of one row whose depth is in range.
struct CountRow {
  ImageView<const float> depth;
  float min_depth_m;
  float max_depth_m;
  std::uint32_t* counts;

  FOOTHOLD_HD void operator()(std::size_t row) const {
    std::uint32_t count = 0;
    for (int u = 0; u < depth.width; ++u) {
      const float depth_m = depth(u, static_cast<int>(row));
      count += depth_m >= min_depth_m && depth_m <= max_depth_m ? 1 : 0;
    }
    counts[row] = count;
  }
};

/// Everything that a step at one level needs.
struct IcpStep {
  DepthLevel live;
  const SurfacePixel* models;  ///< one rendering after another
  Intrinsics model_intrinsics;
  int model_width;
  int model_height;
  float outlier_m;
  float noise_growth;
  float outlier_growth;
  float min_depth_m;
  float max_depth_m;
};

struct IcpScratch {};

/// Sums the normal equations of one alignment over one chunk of pixels; kWidth pixels of a row side by side.
template <int kWidth>
struct SumChunk {
  static constexpr int kGroupsPerChunk = 512 / kWidth;

  IcpStep step;
  int num_chunks;
  const IcpState* states;
  float* chunk_sums;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, IcpScratch&, std::size_t item) const {
    const int alignment = static_cast<int>(item) / num_chunks;
    const int chunk = static_cast<int>(item) % num_chunks;
    const IcpState& state = states[alignment];
    if (state.converged != 0) return;
    const SurfacePixel* const model = step.models + static_cast<std::size_t>(alignment) * static_cast<std::size_t>(step.model_width) *
                                                        static_cast<std::size_t>(step.model_height);
    const int groups_per_row = (step.live.depth.width + kWidth - 1) / kWidth;
    const int num_groups = groups_per_row * step.live.depth.height;
    const int first = chunk * kGroupsPerChunk;
    const SE3 pose = state.trial;
    float sums[kNumSums][kWidth] = {};
    for (int k = team.lane(); k < kGroupsPerChunk; k += team.size()) {
      const int group = first + k;
      if (group < num_groups) add_group(model, group % groups_per_row * kWidth, group / groups_per_row, pose, sums);
    }
    float totals[kNumSums];
    for (int j = 0; j < kNumSums; ++j) {
      totals[j] = 0.0F;
      for (int i = 0; i < kWidth; ++i) totals[j] += sums[j][i];
    }
    team.sum_all(totals);
    for (int j = team.lane(); j < kNumSums; j += team.size()) chunk_sums[item * kNumSums + static_cast<std::size_t>(j)] = totals[j];
  }

 private:
  /// The live points of a group in the model camera's frame, and the pixels of the rendering where they land.
  struct Points {
    float x[kWidth];
    float y[kWidth];
    float z[kWidth];
    float valid[kWidth];  ///< 1 where the live image has depth
    float scale[kWidth];  ///< growth of the outlier distance with depth
    float noise[kWidth];  ///< growth of the noise with depth
    float u[kWidth];      ///< of the rendering, a whole number
    float v[kWidth];
    int pixel[kWidth];  ///< -1 outside the rendering
  };

  FOOTHOLD_HD void add_group(const SurfacePixel* model, int u0, int v, const SE3& pose, float (&sums)[kNumSums][kWidth]) const {
    Points points;
    project(u0, v, pose, points);
    float nx[kWidth];
    float ny[kWidth];
    float nz[kWidth];
    float depth[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const SurfacePixel surface = points.pixel[i] >= 0 ? model[points.pixel[i]] : SurfacePixel{};
      nx[i] = surface.normal_x;
      ny[i] = surface.normal_y;
      nz[i] = surface.normal_z;
      depth[i] = surface.depth_m;
    }
    accumulate(points, nx, ny, nz, depth, sums);
  }

  FOOTHOLD_HD void project(int u0, int v, const SE3& pose, Points& points) const {
    const Intrinsics& k = step.live.intrinsics;
    const int width = step.live.depth.width;
    const float* const row = step.live.depth.data + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    const Eigen::Matrix3f& r = pose.rotation;
    const Eigen::Vector3f& t = pose.translation;
    const float y_ray = (static_cast<float>(v) - k.cy) / k.fy;
    const float inverse_fx = 1.0F / k.fx;
    const float right = static_cast<float>(step.model_width) - 0.5F;
    const float bottom = static_cast<float>(step.model_height) - 0.5F;
    float live[kWidth];
    for (int i = 0; i < kWidth; ++i) live[i] = u0 + i < width ? row[u0 + i] : 0.0F;
    for (int i = 0; i < kWidth; ++i) {
      const bool valid = (live[i] >= step.min_depth_m) & (live[i] <= step.max_depth_m);
      const float z = valid ? live[i] : 0.0F;
      const float x = (static_cast<float>(u0 + i) - k.cx) * inverse_fx * z;
      const float y = y_ray * z;
      const float qx = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + t.x();
      const float qy = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + t.y();
      const float qz = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + t.z();
      const float inverse = 1.0F / qz;
      const float u = step.model_intrinsics.fx * qx * inverse + step.model_intrinsics.cx;
      const float w = step.model_intrinsics.fy * qy * inverse + step.model_intrinsics.cy;
      const bool inside = valid & (qz > 0.0F) & (u > -0.5F) & (w > -0.5F) & (u < right) & (w < bottom);
      const int column = static_cast<int>((inside ? u : 0.0F) + 0.5F);
      const int line = static_cast<int>((inside ? w : 0.0F) + 0.5F);
      points.x[i] = qx;
      points.y[i] = qy;
      points.z[i] = qz;
      points.valid[i] = valid ? 1.0F : 0.0F;
      points.scale[i] = 1.0F + step.outlier_growth * z * z;
      points.noise[i] = 1.0F + step.noise_growth * z * z;
      points.u[i] = static_cast<float>(column);
      points.v[i] = static_cast<float>(line);
      points.pixel[i] = inside ? line * step.model_width + column : -1;
    }
  }

  FOOTHOLD_HD void accumulate(const Points& points, const float (&nx)[kWidth], const float (&ny)[kWidth], const float (&nz)[kWidth],
                              const float (&depth)[kWidth], float (&sums)[kNumSums][kWidth]) const {
    const Intrinsics& k = step.model_intrinsics;
    const float inverse_fx = 1.0F / k.fx;
    const float inverse_fy = 1.0F / k.fy;
    float jacobian[6][kWidth];
    float weight[kWidth];
    float residual[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const float dx = points.x[i] - (points.u[i] - k.cx) * inverse_fx * depth[i];
      const float dy = points.y[i] - (points.v[i] - k.cy) * inverse_fy * depth[i];
      const float dz = points.z[i] - depth[i];
      const float r = nx[i] * dx + ny[i] * dy + nz[i] * dz;
      const float inverse_scale = 1.0F / points.scale[i];
      const float limit = step.outlier_m * points.scale[i];
      const float relative = r * inverse_scale / step.outlier_m;
      const float inside = 1.0F - relative * relative;
      const bool has_normal = nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i] > 0.5F;
      // A point far along the surface from its partner is as wrong as one far off it: occlusion edges.
      const bool partner = has_normal & (inside > 0.0F) & (dx * dx + dy * dy + dz * dz < kMaxPartnerRatio * limit * limit);
      const float w = partner ? inside * inside : 0.0F;
      weight[i] = w / (points.noise[i] * points.noise[i]);
      residual[i] = partner ? r : 0.0F;
      jacobian[0][i] = points.y[i] * nz[i] - points.z[i] * ny[i];
      jacobian[1][i] = points.z[i] * nx[i] - points.x[i] * nz[i];
      jacobian[2][i] = points.x[i] * ny[i] - points.y[i] * nx[i];
      jacobian[3][i] = nx[i];
      jacobian[4][i] = ny[i];
      jacobian[5][i] = nz[i];
      // Tukey's loss relative to its limit, 1 for an outlier: rho = 1 - (1 - (r/c)^2)^3.
      sums[kCostSum][i] += points.valid[i] * (partner ? 1.0F - inside * inside * inside : 1.0F);
      sums[kInlierSum][i] += partner ? 1.0F : 0.0F;
      sums[kValidSum][i] += points.valid[i];
      sums[kMappedSum][i] += has_normal ? points.valid[i] : 0.0F;
    }
    int row = 0;
    for (int a = 0; a < 6; ++a) {
      float weighted[kWidth];
      for (int i = 0; i < kWidth; ++i) weighted[i] = weight[i] * jacobian[a][i];
      for (int b = a; b < 6; ++b, ++row) {
        for (int i = 0; i < kWidth; ++i) sums[row][i] += weighted[i] * jacobian[b][i];
      }
      for (int i = 0; i < kWidth; ++i) sums[kNumHessian + a][i] += weighted[i] * residual[i];
    }
  }

  static constexpr float kMaxPartnerRatio = 9.0F;
};

/// What the lanes that solve a step share.
struct SolveScratch {
  double sums[kNumSums];
};

/// Combines the chunks' sums of one alignment, each by one lane and in order, accepts or rejects the trial pose, and proposes the next.
struct SolveStep {
  IcpState* states;
  const float* chunk_sums;
  int num_chunks;
  bool first_of_level;
  bool rotation_only;
  float converged_step;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, SolveScratch& scratch, std::size_t alignment) const {
    IcpState& state = states[alignment];
    if (state.converged != 0) return;
    double(&sums)[kNumSums] = scratch.sums;
    const float* const own_sums = chunk_sums + alignment * static_cast<std::size_t>(num_chunks * kNumSums);
    for (int j = team.lane(); j < kNumSums; j += team.size()) {
      double sum = 0.0;
      for (int c = 0; c < num_chunks; ++c) sum += static_cast<double>(own_sums[c * kNumSums + j]);
      sums[j] = sum;
    }
    team.sync();
    if (team.lane() != 0) return;
    const double num_valid = sums[kValidSum];
    const double cost = num_valid > 0.0 ? sums[kCostSum] / num_valid : 1.0;
    constexpr float kFirstDamping = 1e-4F;
    if (first_of_level || cost <= state.cost) {
      state.damping = first_of_level ? kFirstDamping : 0.1F * state.damping;
      state.cost = cost;
      state.model_from_camera = state.trial;
      for (int j = 0; j < kNumSums; ++j) state.sums[j] = sums[j];
    } else {
      state.damping *= 10.0F;
    }
    propose(state);
  }

 private:
  FOOTHOLD_HD void propose(IcpState& state) const {
    const int size = rotation_only ? 3 : 6;
    double matrix[6][6];
    double step[6];
    int row = 0;
    for (int a = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b, ++row) {
        matrix[b][a] = state.sums[row];
        matrix[a][b] = state.sums[row];
      }
      matrix[a][a] *= 1.0 + static_cast<double>(state.damping);
      step[a] = -state.sums[kNumHessian + a];
    }
    if (!cholesky_factor(matrix, size)) {
      state.converged = 1;
      return;
    }
    cholesky_solve(matrix, size, step);
    Tangent6 tangent = Tangent6::Zero();
    double length = 0.0;
    for (int a = 0; a < size; ++a) {
      tangent[a] = static_cast<float>(step[a]);
      length += step[a] * step[a];
    }
    state.trial = se3_exp(tangent) * state.model_from_camera;
    if (!(length > static_cast<double>(converged_step) * static_cast<double>(converged_step))) state.converged = 1;
  }
};

/// Starts each alignment.
struct BeginIcp {
  const SE3* world_from_models;
  const SE3* guesses;
  IcpState* states;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    states[i].world_from_model = world_from_models[i];
    states[i].model_from_camera = world_from_models[i].inverse() * guesses[i];
  }
};

/// Starts a level from the best poses of the one before.
struct BeginLevel {
  IcpState* states;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    states[i].trial = states[i].model_from_camera;
    states[i].converged = 0;
  }
};

/// The rotation nearest to a matrix that is one but for rounding, like nearest_rotation() but for kernels, too.
///
/// Newton's iteration X <- X (3 I - X^T X) / 2 squares an error of at most 1e-2 each time. Reference: [Higham1986].
FOOTHOLD_HD inline Eigen::Matrix3f without_rounding_errors(const Eigen::Matrix3f& rotation) {
  constexpr int kNumSteps = 3;
  Eigen::Matrix3d x = rotation.cast<double>();
  for (int i = 0; i < kNumSteps; ++i) {
    const Eigen::Matrix3d square = x.transpose() * x;
    const Eigen::Matrix3d next = 0.5 * (x * (3.0 * Eigen::Matrix3d::Identity() - square));
    x = next;
  }
  return x.cast<float>();
}

/// Says where each alignment ended.
struct EndIcp {
  const IcpState* states;
  SE3* world_from_cameras;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    SE3 pose = states[i].world_from_model * states[i].model_from_camera;
    pose.rotation = without_rounding_errors(pose.rotation);
    world_from_cameras[i] = pose;
  }
};

template <Device kDevice>
void IcpOps<kDevice>::build_pyramid(const Context& context, const IcpSettings& settings, Scratch& scratch) {
  const typename ExecutorOf<kDevice>::Type exec(context);
  for (int l = 1; l <= settings.coarsest_level; ++l) {
    const DepthLevel& fine = scratch.levels[l - 1];
    const DepthLevel& coarse = scratch.levels[l];
    exec.for_each(coarse.depth.size(), HalveDepth{fine.depth, settings.min_depth_m, settings.max_depth_m,
                                                  scratch.depths_m[static_cast<std::size_t>(l - 1)].data(), coarse.depth.width});
  }
}

template <Device kDevice>
std::uint32_t IcpOps<kDevice>::count_depth(const Context& context, const IcpSettings& settings, Scratch& scratch) {
  const typename ExecutorOf<kDevice>::Type exec(context);
  const ImageView<const float>& depth = scratch.levels[settings.finest_level].depth;
  const auto num_rows = static_cast<std::size_t>(depth.height);
  scratch.row_counts.resize(num_rows);
  scratch.row_offsets.resize(num_rows + 1);
  exec.for_each(num_rows, CountRow{depth, settings.min_depth_m, settings.max_depth_m, scratch.row_counts.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.row_counts), Span<std::uint32_t>(scratch.row_offsets));
  return scratch.row_offsets.read(context, num_rows);
}

template <Device kDevice>
void IcpOps<kDevice>::align(const Context& context, const IcpSettings& settings, const SurfaceMap& models, const SE3* guesses,
                            Scratch& scratch) {
  using Exec = typename ExecutorOf<kDevice>::Type;
  constexpr int kWidth = Exec::kVectorWidth;
  const Exec exec(context);
  const std::size_t num_alignments = models.num_renderings();
  scratch.states.resize(num_alignments);
  IcpState* const states = scratch.states.data();
  exec.for_each(num_alignments, BeginIcp{models.world_from_cameras.data(), guesses, states});
  for (int l = settings.coarsest_level; l >= settings.finest_level; --l) {
    const DepthLevel& live = scratch.levels[l];
    const float t =
        settings.coarsest_level == settings.finest_level
            ? 0.0F
            : static_cast<float>(l - settings.finest_level) / static_cast<float>(settings.coarsest_level - settings.finest_level);
    const float outlier_m = settings.finest_outlier_m * std::pow(settings.coarsest_outlier_m / settings.finest_outlier_m, t);
    const int num_steps =
        settings.finest_steps + static_cast<int>(std::lround(t * static_cast<float>(settings.coarsest_steps - settings.finest_steps)));
    const IcpStep step{live,      models.pixels.data(),  models.camera.intrinsics, models.camera.width,  models.camera.height,
                       outlier_m, settings.noise_growth, settings.outlier_growth,  settings.min_depth_m, settings.max_depth_m};
    const int num_groups = (live.depth.width + kWidth - 1) / kWidth * live.depth.height;
    const int num_chunks = (num_groups + SumChunk<kWidth>::kGroupsPerChunk - 1) / SumChunk<kWidth>::kGroupsPerChunk;
    const std::size_t num_teams = num_alignments * static_cast<std::size_t>(num_chunks);
    scratch.chunk_sums.resize(num_teams * kNumSums);
    float* const sums = scratch.chunk_sums.data();
    exec.for_each(num_alignments, BeginLevel{states});
    for (int i = 0; i < num_steps; ++i) {
      exec.template for_each_team<IcpScratch>(num_teams, SumChunk<kWidth>{step, num_chunks, states, sums});
      const bool rotation_only = settings.rotation_first && l == settings.coarsest_level;
      exec.template for_each_team<SolveScratch>(num_alignments,
                                                SolveStep{states, sums, num_chunks, i == 0, rotation_only, settings.converged_step});
      if constexpr (kDevice == Device::kCpu) {
        if (std::all_of(states, states + num_alignments, [](const IcpState& state) { return state.converged != 0; })) break;
      }
    }
  }
  scratch.world_from_cameras.resize(num_alignments);
  exec.for_each(num_alignments, EndIcp{states, scratch.world_from_cameras.data()});
}

}  // namespace foothold
