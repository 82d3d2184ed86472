// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/icp_tracker.h"

#include <Eigen/Eigenvalues>

#include "foothold/base/contract.h"
#include "foothold/base/exec/dispatch.h"
#include "icp/icp_tracker_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct IcpAlgorithms<CudaExecutor>;
#endif

IcpLevels IcpLevels::for_divisor(int divisor) {
  const int level = static_cast<int>(std::lround(std::log2(static_cast<double>(divisor))));
  const int finest = std::min(level, kMaxIcpLevels - 2);
  return {finest + 1, finest};
}

IcpTracker::IcpTracker(const Context& context, const IcpLevels& levels, const DepthRange& range)
    : context_(context), levels_(levels), range_(range), scratch_(std::make_unique<Scratch>(context.memory())) {
  FOOTHOLD_EXPECTS(levels.finest >= 0 && levels.finest <= levels.coarsest && levels.coarsest < kMaxIcpLevels);
}
IcpTracker::~IcpTracker() = default;
IcpTracker::IcpTracker(IcpTracker&&) noexcept = default;
IcpTracker& IcpTracker::operator=(IcpTracker&&) noexcept = default;

void IcpTracker::set_frame(const Frame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  FOOTHOLD_EXPECTS(frame.depth.memory == context_.memory());
  const ScopedStage stage(context_, "fusion/pyramid");
  Scratch& scratch = *scratch_;
  scratch.frame = frame;
  scratch.levels[0] = {frame.depth, frame.calibration.depth};
  while (scratch.depths_m.size() < static_cast<std::size_t>(levels_.coarsest)) scratch.depths_m.emplace_back(context_.memory());
  for (int l = 1; l <= levels_.coarsest; ++l) {
    const DepthLevel& fine = scratch.levels[l - 1];
    const int width = fine.depth.width / 2;
    const int height = fine.depth.height / 2;
    Array<float>& depths_m = scratch.depths_m[static_cast<std::size_t>(l - 1)];
    depths_m.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    scratch.levels[l] = {{depths_m.data(), width, height, context_.memory()}, fine.intrinsics.scaled(0.5F)};
  }
  dispatch(context_, [&](auto on) { IcpAlgorithms<typename decltype(on)::Executor>::build_pyramid(context_, levels_, range_, scratch); });
}

namespace {
Eigen::Matrix<double, 6, 6> hessian_of(const IcpState& state) {
  Eigen::Matrix<double, 6, 6> hessian;
  int row = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b, ++row) {
      hessian(a, b) = state.sums[row];
      hessian(b, a) = state.sums[row];
    }
  }
  return hessian;
}

/// log det(H / count), or nothing if H is not positive definite.
bool log_determinant(const Eigen::Matrix<double, 6, 6>& hessian, double count, float& result) {
  double matrix[6][6];
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < 6; ++b) matrix[a][b] = hessian(a, b) / count;
  }
  if (!(count > 0.0) || !cholesky_factor(matrix)) return false;
  double sum = 0.0;
  for (int a = 0; a < 6; ++a) sum += 2.0 * std::log(matrix[a][a]);
  result = static_cast<float>(sum);
  return true;
}

/// The unit translation, in the rendering's frame, whose cost grows least when rotation minimises it: the eigenvector of the smallest
/// eigenvalue of H's Schur complement S = H_tt - H_rt^T H_rr^-1 H_rt.
/// @param hold  Output: that eigenvalue over the sum of weights, which is the trace of H_tt.
Eigen::Vector3f loosest_translation(const Eigen::Matrix<double, 6, 6>& hessian, float& hold) {
  const Eigen::Matrix3d coupling = hessian.topRightCorner<3, 3>();
  const Eigen::Matrix3d rotation = hessian.topLeftCorner<3, 3>();
  const Eigen::Matrix3d complement = hessian.bottomRightCorner<3, 3>() - coupling.transpose() * rotation.ldlt().solve(coupling);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(complement);  // eigenvalues rise
  hold = static_cast<float>(solver.eigenvalues()[0] / hessian.bottomRightCorner<3, 3>().trace());
  return solver.eigenvectors().col(0).cast<float>();
}

/// Alignments on less of a frame than this count as if it were that much: a patch that agrees with itself is no evidence. The same
/// part as kMinOverlap, under which poses are refused without asking.
constexpr double kLeastMappedPart = 0.2;

/// @param num_total  Pixels at the finest level.
TrackingResult summarise(const IcpState& state, const SE3& world_from_camera, double num_total) {
  TrackingResult result;
  result.world_from_camera = world_from_camera;
  const double num_inliers = state.sums[kInlierSum];
  const double num_valid = state.sums[kValidSum];
  const double num_mapped = state.sums[kMappedSum];
  result.num_inliers = static_cast<int>(num_inliers);
  result.num_valid = static_cast<int>(num_valid);
  result.num_mapped = static_cast<int>(num_mapped);
  TrackingMeasures& measures = result.measures;
  const Eigen::Matrix<double, 6, 6> hessian = hessian_of(state);
  measures.well_posed =
      log_determinant(hessian, num_total, measures.log_det_total) && log_determinant(hessian, num_valid, measures.log_det_valid);
  if (measures.well_posed) result.loosest_world = state.world_from_model.rotation * loosest_translation(hessian, result.hold);
  if (num_valid > 0.0) {
    const double num_counted = std::max(num_mapped, kLeastMappedPart * num_valid);
    measures.inlier_fraction = static_cast<float>(num_inliers / num_counted);
    const double inliers_cost = state.sums[kCostSum] - (num_valid - num_inliers);
    // Tukey's loss saturates at c^2 / 6 in units of a squared residual.
    const double squared =
        (inliers_cost * kFinestOutlierM * kFinestOutlierM / 6.0 + (num_counted - num_inliers) * kCoarsestOutlierM * kCoarsestOutlierM) /
        num_counted;
    measures.residual_m = static_cast<float>(std::sqrt(std::max(0.0, squared)));
  }
  return result;
}
}  // namespace

bool IcpTracker::sees_depth() {
  FOOTHOLD_EXPECTS(!scratch_->levels[0].depth.empty());
  return dispatch(context_, [&](auto on) {
           return IcpAlgorithms<typename decltype(on)::Executor>::count_depth(context_, levels_.finest, range_, *scratch_);
         }) > 0;
}

void IcpTracker::make_surface(SurfaceMap& surface) const {
  const DepthLevel& level = scratch_->levels[levels_.finest];
  FOOTHOLD_EXPECTS(!level.depth.empty() && surface.pixels.memory() == context_.memory());
  surface.camera = {level.intrinsics, level.depth.width, level.depth.height, SE3{}};
  surface.world_from_cameras.assign(context_, Span<const SE3>(&surface.camera.world_from_camera, 1));
  surface.pixels.resize(level.depth.size());
  surface.colours.resize(0);
  dispatch(context_, [&](auto on) {
    IcpAlgorithms<typename decltype(on)::Executor>::make_surface(context_, levels_.finest, range_, *scratch_, surface);
  });
}

TrackingResult IcpTracker::track(const SurfaceMap& model, const SE3& guess_world_from_camera) {
  scratch_->guess.assign(context_, Span<const SE3>(&guess_world_from_camera, 1));
  const auto align = [&](IcpResiduals residuals) {
    align_all(model, scratch_->guess, residuals);
    HostReads reads;
    queue_results(reads);
    reads.wait(context_);
    return results().front();
  };
  const TrackingResult result = align(IcpResiduals::kDepth);
  return needs_greys(model, result) ? align(IcpResiduals::kDepthAndGrey) : result;
}

bool IcpTracker::needs_greys(const SurfaceMap& model, const TrackingResult& by_depth) {
  return by_depth.measures.well_posed && by_depth.hold < kLeastHold && !model.colours.empty();
}

void IcpTracker::align_all(const SurfaceMap& models, const Array<SE3>& guesses_world_from_camera, IcpResiduals residuals) {
  FOOTHOLD_EXPECTS(!scratch_->levels[0].depth.empty() && !models.empty());
  FOOTHOLD_EXPECTS(models.pixels.memory() == context_.memory() && guesses_world_from_camera.memory() == context_.memory());
  FOOTHOLD_EXPECTS(guesses_world_from_camera.size() == models.num_renderings());
  FOOTHOLD_EXPECTS(residuals == IcpResiduals::kDepth || !models.colours.empty());
  const ScopedStage stage(context_, "fusion/track");
  dispatch(context_, [&](auto on) {
    using Algorithms = IcpAlgorithms<typename decltype(on)::Executor>;
    const SE3* const guesses = guesses_world_from_camera.data();
    const auto align = residuals == IcpResiduals::kDepth ? Algorithms::align_by_depth : Algorithms::align_by_both;
    align(context_, levels_, range_, models, guesses, *scratch_);
  });
}

const Array<SE3>& IcpTracker::world_from_cameras() const { return scratch_->world_from_cameras; }

void IcpTracker::queue_results(HostReads& reads) {
  reads.add(scratch_->states, scratch_->host_states);
  reads.add(scratch_->world_from_cameras, scratch_->host_world_from_cameras);
}

std::vector<TrackingResult> IcpTracker::results() const {
  const auto num_total = static_cast<double>(scratch_->levels[levels_.finest].depth.size());
  std::vector<TrackingResult> results;
  for (std::size_t i = 0; i < scratch_->host_states.size(); ++i)
    results.push_back(summarise(scratch_->host_states[i], scratch_->host_world_from_cameras[i], num_total));
  return results;
}

}  // namespace foothold
