// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "benchmark_frames.h"
#include "device_rig.h"
#include "foothold/base/trace.h"
#include "foothold/synthetic/turned_frame.h"

namespace foothold::benchmark {
namespace {

/// Durations by name, in the order in which names first came.
class Table {
 public:
  void add(const std::string& name, double duration_ms) {
    if (durations_ms_.find(name) == durations_ms_.end()) names_.push_back(name);
    durations_ms_[name].push_back(duration_ms);
  }
  void print(const std::string& title) const {
    std::printf("\n| %s | median [ms] | 95 %% [ms] | calls |\n|---|---:|---:|---:|\n", title.c_str());
    for (const std::string& name : names_) {
      const std::vector<double>& durations = durations_ms_.at(name);
      std::printf("| %s | %.3f | %.3f | %zu |\n", name.c_str(), quantile(durations, 0.5), quantile(durations, 0.95), durations.size());
    }
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> durations_ms_;
};

/// Views of one kind, to be relocalised in the scene that was learnt.
struct Views {
  std::string name;
  std::vector<RgbdFrame> frames;
};

std::vector<Views> kinds_of_views(const std::vector<RgbdFrame>& frames, const std::vector<RgbdFrame>& elsewhere) {
  std::vector<Views> kinds = {{"a learnt view", {}}, {"a learnt view, turned by 90 deg", {}}, {"a learnt view, upside down", {}}};
  constexpr std::size_t kStride = 4;
  for (std::size_t i = 0; i < frames.size(); i += kStride) {
    kinds[0].frames.push_back(frames[i]);
    kinds[1].frames.push_back(turned_frame(frames[i], 1));
    kinds[2].frames.push_back(turned_frame(frames[i], 2));
  }
  kinds.push_back({"another place", elsewhere});
  return kinds;
}

/// Learns, relocalises, refines and fuses; calls `timed(name, call)` for each whole call.
template <class Timed>
class Run {
 public:
  Run(DeviceRig& rig, Timed timed) : rig_(rig), timed_(std::move(timed)) {}

  void learn(const RgbdFrame& recorded) {
    const Frame frame = upload(recorded);
    relocalise("the next view, not learnt yet", frame);
    timed_("train", [&] { rig_.relocaliser.train(frame, *recorded.world_from_camera); });
    if (num_learnt_++ == 0) rig_.pipeline.start_at(*recorded.world_from_camera);
    timed_("fuse: track, judge, integrate, render", [&] { num_fused_ += rig_.pipeline.process(frame).fused ? 1 : 0; });
  }
  void find(const Views& views) {
    for (const RgbdFrame& recorded : views.frames) {
      const Frame frame = upload(recorded);
      relocalise(views.name, frame);
    }
  }
  void refine(const Views& views) {
    for (const RgbdFrame& recorded : views.frames) {
      const Frame frame = upload(recorded);
      const std::vector<PoseEstimate> proposals = rig_.relocaliser.relocalise(frame);
      if (proposals.empty()) continue;
      timed_("refine the candidates of " + views.name, [&] { rig_.refiner.refine(frame, rig_.pipeline.volume(), proposals); });
    }
  }
  int num_fused() const { return num_fused_; }

 private:
  Frame upload(const RgbdFrame& recorded) {
    Frame frame;
    timed_("upload", [&] { frame = rig_.uploader.upload(recorded.view()); });
    return frame;
  }
  std::vector<PoseEstimate> relocalise(const std::string& name, const Frame& frame) {
    std::vector<PoseEstimate> found;
    timed_("relocalise " + name, [&] { found = rig_.relocaliser.relocalise(frame); });
    return found;
  }

  DeviceRig& rig_;
  Timed timed_;
  int num_learnt_ = 0;
  int num_fused_ = 0;
};

/// One pass over all frames and kinds of views; `is_counted` turns true behind the warm-up.
template <class Timed>
int run_all(DeviceRig& rig, const std::vector<RgbdFrame>& frames, const std::vector<Views>& kinds, const Options& options, bool& is_counted,
            const Timed& timed) {
  Run<Timed> run(rig, timed);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    is_counted = static_cast<int>(i) >= options.num_warm_up;
    run.learn(frames[i]);
  }
  for (const Views& views : kinds) run.find(views);
  run.refine(kinds.front());
  return run.num_fused();
}

void time_whole_calls(const Options& options, const std::vector<RgbdFrame>& frames, const std::vector<Views>& kinds) {
  DeviceRig rig(make_context(options), options.preset);
  Table table;
  bool is_counted = false;
  const int num_fused = run_all(rig, frames, kinds, options, is_counted, [&](const std::string& name, const auto& call) {
    rig.context.synchronise();
    const Stopwatch watch;
    call();
    rig.context.synchronise();
    if (is_counted) table.add(name, watch.elapsed_ms());
  });
  table.print("whole calls");
  std::printf("\n%d of %zu frames fused; the scene takes %.1f MB, the map has %d blocks\n", num_fused, frames.size(),
              1e-6 * static_cast<double>(rig.relocaliser.state_bytes()), rig.pipeline.volume().num_blocks());
}

void time_stages(const Options& options, const std::vector<RgbdFrame>& frames, const std::vector<Views>& kinds) {
  Trace trace;
  DeviceRig rig(make_context(options, &trace), options.preset);
  Table table;
  bool is_counted = false;
  run_all(rig, frames, kinds, options, is_counted, [&](const std::string&, const auto& call) {
    trace.clear();
    call();
    if (!is_counted) return;
    for (const auto& [stage, durations_ms] : trace.stages()) {
      for (const double duration_ms : durations_ms) table.add(stage, duration_ms);
    }
  });
  table.print("stages");
}

}  // namespace

void time_calls(const Options& options) {
  const Context context = make_context(options);  // throws before anything is loaded
  constexpr int kNumElsewhere = 40;
  const std::vector<RgbdFrame> frames = load_frames(options.sequence, options.num_frames, options.num_warm_up + 1);
  const std::vector<Views> kinds = kinds_of_views(frames, load_frames(options.elsewhere, std::min(options.num_frames, kNumElsewhere), 1));
  std::printf("%s, %d host threads, %s preset, %zu frames of %dx%d pixels from %s, the first %d to warm up\n",
              context.device_name().c_str(), context.num_threads(), options.preset.c_str(), frames.size(), frames[0].depth.width(),
              frames[0].depth.height(), options.sequence.c_str(), options.num_warm_up);
  time_whole_calls(options, frames, kinds);
  time_stages(options, frames, kinds);
}

}  // namespace foothold::benchmark
