// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "replay.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <numeric>

#include "common/peak_memory.h"
#include "common/played_frame.h"
#include "common/progress_bar.h"
#include "common/unhurried_player.h"
#include "foothold/base/error.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/surface_mesh.h"
#include "foothold/io/sequence.h"
#include "foothold/io/sequence_player.h"
#include "foothold/reconstruction/reconstruction.h"
#include "mapped_fraction.h"
#include "outside_picture.h"
#include "replay_view.h"

namespace foothold::replay {
namespace {

/// Size of the picture from outside [px].
constexpr int kPictureWidth = 960;
constexpr int kPictureHeight = 720;
/// Colour of a covered lens.
constexpr Rgb8 kDark = {4, 4, 4};

double process_cpu_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Forest make_forest(const std::string& choice, const ReplaySettings& settings) {
  if (choice == "default") return default_forest();
  if (choice == "random") return make_random_forest(settings.random_forest);
  return load_forest(choice);
}

/// @throws InvalidSettings, FileError, DeviceError
Reconstruction make_reconstruction(const Context& context, const ReplayOptions& options, const ReplaySettings& settings) {
  if (options.method == "forest") {
    return {context, settings.fusion, ForestRelocaliser(context, make_forest(options.forest, settings), settings.forest)};
  }
  if (options.method == "ferns") return {context, settings.fusion, KeyframeRelocaliser(context, settings.ferns)};
  return {context, settings.fusion};
}

std::string describe(const Kidnap& kidnap) {
  const std::string from = std::to_string(kidnap.from);
  const std::string to = std::to_string(kidnap.to);
  switch (kidnap.kind) {
    case KidnapKind::kRemoved:
      return "frames " + from + " to " + std::to_string(kidnap.to - 1) + " left out";
    case KidnapKind::kTeleport:
      return "jumped from frame " + from + " back to " + to;
    case KidnapKind::kReturn:
      return "jumped from frame " + from + " to " + to;
    case KidnapKind::kLeap:
      return "jumped from frame " + from + " ahead to " + to;
    case KidnapKind::kBlackout:
      return "the lens was covered from frame " + from + " to " + std::to_string(kidnap.to - 1);
  }
  return {};
}

Image<Rgb8> draw_outside(const TsdfVolume& volume, const ReplayRun& run) {
  std::vector<SE3> trajectory;
  for (const ReplayFrame& frame : run.frames) {
    if (frame.result.world_from_camera.has_value()) trajectory.push_back(*frame.result.world_from_camera);
  }
  return picture_from_outside(volume, run.mesh, trajectory, kPictureWidth, kPictureHeight);
}

class Replayer {
 public:
  Replayer(const ReplayOptions& options, const ReplaySettings& settings)
      : options_(options),
        settings_(settings),
        context_(apps::make_context(options.device)),
        sequence_(open_sequence(options.sequence, apps::make_context(options.device), options.recording)),
        indices_(frame_indices(*sequence_, options.stride)),
        view_(context_, options) {
    if (indices_.empty()) throw FileError(options.sequence + ": expected at least one frame");
  }

  ReplayResult run();

 private:
  int num_frames() const { return static_cast<int>(indices_.size()); }
  bool stopped() const { return apps::interrupted() || view_.ended() || !broken_off_.empty(); }
  /// Reads a frame. @return False at the end, and where the recording is damaged: what was played so far is worth keeping.
  bool read(FrameSource& source, RgbdFrame& frame);
  Reconstruction start() const;
  /// Every frame once, in order.
  std::vector<PlayStep> all_frames() const { return plan_sequential_kidnaps(num_frames(), {}).steps; }
  std::unique_ptr<FrameSource> open(const std::vector<PlayStep>& steps) const;
  ReplayFrame show(Reconstruction& reconstruction, RgbdFrame& frame, const PlayStep& step, const std::string& event);
  /// Plays steps. `before` is called before each with the last frame and the position in the steps.
  template <class Before>
  ReplayRun play(const std::string& label, Reconstruction& reconstruction, const std::vector<PlayStep>& steps,
                 const std::vector<Kidnap>& kidnaps, Before&& before);
  ReplayRun play_undisturbed(const std::vector<Kidnap>& independent, std::vector<KidnapRecord>& records);
  void play_kidnapped(const KidnapPlan& plan, ReplayResult& result);
  KidnapRecord branch_off(const Reconstruction& reconstruction, const Kidnap& kidnap, const ReplayRun& so_far);
  std::optional<double> mapped_part(const Reconstruction& reconstruction, const ReplayFrame& last, const RgbdFrame& first) const;
  void judge_kidnaps(ReplayResult& result) const;
  Mesh mesh_from_true_poses() const;
  void compare_surfaces(ReplayResult& result) const;

  const ReplayOptions& options_;
  const ReplaySettings& settings_;
  Context context_;
  std::shared_ptr<const Sequence> sequence_;
  std::vector<int> indices_;
  ReplayView view_;
  std::string broken_off_;  ///< what is wrong with the recording from here on
};

Reconstruction Replayer::start() const {
  Reconstruction reconstruction = make_reconstruction(context_, options_, settings_);
  const std::optional<SE3> first = sequence_->load(indices_.front()).world_from_camera;
  if (first.has_value()) reconstruction.start_at(*first);
  return reconstruction;
}

std::unique_ptr<FrameSource> Replayer::open(const std::vector<PlayStep>& steps) const {
  std::vector<int> indices;
  indices.reserve(steps.size());
  for (const PlayStep& step : steps) indices.push_back(indices_[static_cast<std::size_t>(step.frame)]);
  if (options_.exclusive_timing) return std::make_unique<apps::UnhurriedPlayer>(sequence_, std::move(indices));
  return std::make_unique<SequencePlayer>(sequence_, std::move(indices));
}

bool Replayer::read(FrameSource& source, RgbdFrame& frame) {
  try {
    return source.read(frame) == ReadStatus::kFrame;
  } catch (const FileError& error) {
    broken_off_ = error.what();
    return false;
  }
}

ReplayFrame Replayer::show(Reconstruction& reconstruction, RgbdFrame& frame, const PlayStep& step, const std::string& event) {
  if (step.covered) {
    std::fill_n(frame.depth.data(), frame.depth.size(), 0.0F);
    std::fill_n(frame.colour.data(), frame.colour.size(), kDark);
  }
  const bool has_depth = std::any_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), is_valid_depth);
  ReplayFrame result{
      step, frame.index, frame.timestamp_s, frame.world_from_camera, has_depth, {}, std::numeric_limits<double>::quiet_NaN()};
  const double cpu_before_ms = process_cpu_ms();
  result.result = reconstruction.process(frame.view());
  if (options_.exclusive_timing) {
    reconstruction.wait_for_learning();  // which is this frame's, too
    result.cpu_ms = process_cpu_ms() - cpu_before_ms;
  }
  view_.add(frame, reconstruction.pipeline(), result.result, event);
  return result;
}

template <class Before>
ReplayRun Replayer::play(const std::string& label, Reconstruction& reconstruction, const std::vector<PlayStep>& steps,
                         const std::vector<Kidnap>& kidnaps, Before&& before) {
  ReplayRun run;
  view_.start_again(label);
  const std::unique_ptr<FrameSource> source = open(steps);
  apps::ProgressBar progress(label, static_cast<std::int64_t>(steps.size()));
  Stopwatch watch;
  double elsewhere_ms = 0.0;
  RgbdFrame frame;
  for (const PlayStep& step : steps) {
    const Stopwatch aside;
    before(run, step);
    elsewhere_ms += aside.elapsed_ms();
    if (stopped() || !read(*source, frame)) break;
    const bool is_first_covered = step.covered && (run.frames.empty() || !run.frames.back().step.covered);
    const std::string event = step.kidnap >= 0   ? describe(kidnaps[static_cast<std::size_t>(step.kidnap)])
                              : is_first_covered ? "the lens is covered"
                                                 : "";
    run.frames.push_back(show(reconstruction, frame, step, event));
    progress.advance();
  }
  run.wall_s = (watch.elapsed_ms() - elsewhere_ms) / 1000.0;
  run.mesh = extract_mesh(reconstruction.pipeline().volume());
  if (!options_.picture_file.empty()) run.picture = draw_outside(reconstruction.pipeline().volume(), run);
  run.map_bytes = reconstruction.pipeline().volume().state_bytes();
  run.relocaliser_bytes = reconstruction.relocaliser_bytes();
  return run;
}

std::optional<double> Replayer::mapped_part(const Reconstruction& reconstruction, const ReplayFrame& last, const RgbdFrame& first) const {
  if (!last.result.world_from_camera.has_value() || !last.world_from_camera_true.has_value() || !first.world_from_camera.has_value()) {
    return std::nullopt;
  }
  const SE3 first_from_last = last.world_from_camera_true->inverse() * *first.world_from_camera;
  return mapped_fraction(context_, reconstruction.pipeline(), first.view(), *last.result.world_from_camera * first_from_last);
}

KidnapRecord Replayer::branch_off(const Reconstruction& reconstruction, const Kidnap& kidnap, const ReplayRun& so_far) {
  KidnapRecord record;
  record.kidnap = kidnap;
  Reconstruction copy(reconstruction);
  const std::vector<PlayStep> steps = independent_steps(kidnap, num_frames(), options_.kidnaps);
  const std::unique_ptr<FrameSource> source = open(steps);
  view_.begin_branch();
  RgbdFrame frame;
  for (const PlayStep& step : steps) {
    if (stopped() || !read(*source, frame)) break;
    if (step.kidnap >= 0) record.mapped = mapped_part(copy, so_far.frames.back(), frame);
    const ReplayFrame shown = show(copy, frame, step, step.kidnap >= 0 ? describe(kidnap) : std::string());
    if (!step.covered) record.frames.push_back(shown);
  }
  view_.end_branch();
  return record;
}

ReplayRun Replayer::play_undisturbed(const std::vector<Kidnap>& independent, std::vector<KidnapRecord>& records) {
  Reconstruction reconstruction = start();
  std::size_t next = 0;
  const auto branch_where_due = [&](const ReplayRun& so_far, const PlayStep& step) {
    for (; next < independent.size() && independent[next].from == step.frame && !stopped(); ++next) {
      records.push_back(branch_off(reconstruction, independent[next], so_far));
    }
  };
  return play(independent.empty() ? "undisturbed" : "undisturbed, with kidnaps of copies", reconstruction, all_frames(), {},
              branch_where_due);
}

void Replayer::play_kidnapped(const KidnapPlan& plan, ReplayResult& result) {
  Reconstruction reconstruction = start();
  for (const Kidnap& kidnap : plan.kidnaps) result.kidnaps.push_back({kidnap, {}, std::nullopt, {}});
  const auto measure_view = [&](const ReplayRun& so_far, const PlayStep& step) {
    if (step.kidnap < 0 || so_far.frames.empty()) return;
    const auto last =
        std::find_if(so_far.frames.rbegin(), so_far.frames.rend(), [](const ReplayFrame& frame) { return !frame.step.covered; });
    const RgbdFrame first = sequence_->load(indices_[static_cast<std::size_t>(step.frame)]);
    if (last != so_far.frames.rend()) {
      result.kidnaps[static_cast<std::size_t>(step.kidnap)].mapped = mapped_part(reconstruction, *last, first);
    }
  };
  result.kidnapped = play("kidnapped", reconstruction, plan.steps, plan.kidnaps, measure_view);
  const std::vector<ReplayFrame>& frames = result.kidnapped->frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].step.kidnap < 0) continue;
    const std::size_t end = std::min(frames.size(), i + static_cast<std::size_t>(options_.kidnaps.num_judged));
    result.kidnaps[static_cast<std::size_t>(frames[i].step.kidnap)].frames.assign(frames.begin() + static_cast<std::ptrdiff_t>(i),
                                                                                  frames.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

/// Compares with the undisturbed run's poses of the same frames.
void Replayer::judge_kidnaps(ReplayResult& result) const {
  const auto outcome_of = [&](const std::vector<ReplayFrame>& frames) {
    std::vector<PlayedFrame> seen;
    std::vector<std::optional<SE3>> reference;
    for (const ReplayFrame& frame : frames) {
      const auto place = static_cast<std::size_t>(frame.step.frame);
      const bool known = !frame.step.covered && place < result.undisturbed.frames.size();
      seen.push_back(apps::played(frame.result));
      reference.push_back(known ? result.undisturbed.frames[place].result.world_from_camera : std::nullopt);
    }
    return judge_kidnap(seen, reference);
  };
  for (KidnapRecord& record : result.kidnaps) record.outcome = outcome_of(record.frames);
  if (result.kidnapped.has_value()) result.whole_kidnapped = outcome_of(result.kidnapped->frames);
}

Mesh Replayer::mesh_from_true_poses() const {
  TsdfVolume volume(context_, settings_.fusion.volume);
  const std::unique_ptr<FrameSource> source = open(all_frames());
  apps::ProgressBar progress("fusing from true poses", num_frames());
  FrameUploader uploader(context_);
  RgbdFrame frame;
  while (!stopped() && source->read(frame) == ReadStatus::kFrame) {
    if (frame.world_from_camera.has_value()) volume.integrate(uploader.upload(frame.view()), *frame.world_from_camera);
    progress.advance();
  }
  if (stopped()) return {};  // part of a surface is no reference
  return extract_mesh(volume);
}

/// Against one another, and against what the recording's own poses make of all its frames.
void Replayer::compare_surfaces(ReplayResult& result) const {
  const auto voxel_m = static_cast<double>(settings_.fusion.volume.voxel_size_m);
  const double limit_m = std::max(0.05, voxel_m);
  const auto compare = [&](const char* run, const Mesh& mesh, const char* reference_name, const Mesh& reference) {
    if (mesh.vertices.empty() || reference.vertices.empty()) return;
    result.surfaces.push_back(
        {run, reference_name, mesh_distance(mesh, reference, voxel_m, limit_m), mesh_distance(reference, mesh, voxel_m, limit_m)});
  };
  const Mesh& undisturbed = result.undisturbed.mesh;
  const Mesh& kidnapped = result.kidnapped->mesh;
  compare("kidnapped", kidnapped, "undisturbed", undisturbed);
  const Mesh from_true_poses = mesh_from_true_poses();
  compare("undisturbed", undisturbed, "true poses", from_true_poses);
  compare("kidnapped", kidnapped, "true poses", from_true_poses);
}

ReplayResult Replayer::run() {
  ReplayResult result;
  apps::restart_peak_memory();
  const bool with_kidnaps = options_.kidnaps.num_kidnaps() > 0;
  std::vector<Kidnap> independent;
  KidnapPlan plan;  // made before anything runs, so that one that does not fit is refused at once
  if (with_kidnaps && options_.independent) independent = plan_independent_kidnaps(num_frames(), options_.kidnaps);
  if (with_kidnaps && !options_.independent) plan = plan_sequential_kidnaps(num_frames(), options_.kidnaps);
  result.undisturbed = play_undisturbed(independent, result.kidnaps);
  if (result.undisturbed.frames.empty() && !broken_off_.empty()) throw FileError(broken_off_);
  if (!plan.steps.empty() && !stopped()) play_kidnapped(plan, result);
  judge_kidnaps(result);
  result.peak_mb = apps::peak_memory_mb();  // before surfaces are compared, which is no part of reconstruction
  if (result.kidnapped.has_value() && !stopped()) compare_surfaces(result);
  result.complete = !stopped();
  result.broken_off = broken_off_;
  result.origin_m = sequence_->origin_m();
  return result;
}

}  // namespace

ReplayResult replay(const ReplayOptions& options, const ReplaySettings& settings) { return Replayer(options, settings).run(); }

std::optional<RunError> run_error(const ReplayRun& run) {
  std::vector<SE3> estimated;
  std::vector<SE3> truth;
  for (const ReplayFrame& frame : run.frames) {
    if (!frame.result.world_from_camera.has_value() || !frame.world_from_camera_true.has_value()) continue;
    estimated.push_back(*frame.result.world_from_camera);
    truth.push_back(*frame.world_from_camera_true);
  }
  if (estimated.empty()) return std::nullopt;
  const bool began_at_truth = run.frames.front().world_from_camera_true.has_value();
  if (!began_at_truth) {  // the run has a world of its own: it is laid over the true one where both are first known
    const SE3 truth_from_run = truth.front() * estimated.front().inverse();
    for (SE3& pose : estimated) pose = truth_from_run * pose;
  }
  RunError error;
  error.num_frames = static_cast<int>(estimated.size());
  error.raw = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kNone);
  error.aligned = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kRigid);
  return error;
}

}  // namespace foothold::replay
