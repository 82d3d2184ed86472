// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "live_run.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <exception>

#include "common/display_probe.h"
#include "common/log.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/frames/register_colour.h"
#include "foothold/fusion/surface_mesh.h"
#include "foothold/io/mesh_file.h"

namespace foothold::live {
namespace {

constexpr int kEscape = 27;

/// A name for what is saved without one being given, the same for all of a run.
std::string default_name(const char* ending) {
  static const std::time_t start = std::time(nullptr);
  std::tm time{};
  localtime_r(&start, &time);
  std::array<char, 40> stem{};
  std::strftime(stem.data(), stem.size(), "live-%Y%m%d-%H%M%S", &time);
  return stem.data() + std::string(ending);
}

std::string camera_name(const OpenNIDeviceInfo& device) { return device.vendor + " " + device.name; }

}  // namespace

LiveRun::LiveRun(const LiveOptions& options, const LiveSettings& settings)
    : options_(options), keys_(scripted_keys(options.keys)), context_(apps::make_context(options.device)), guide_(options.fast) {
  check_options(options);
  if (!options.record_only) {
    reconstruction_ =
        std::make_unique<Reconstruction>(context_, settings, options.forest.empty() ? default_forest() : load_forest(options.forest));
    monitor_ = std::make_unique<apps::ReconstructionMonitor>(context_);
  }
  if (!options.load_scene.empty()) load_scene(options.load_scene);
  std::string missing = options.headless ? std::string() : apps::describe_missing_display();
  if (!missing.empty()) throw DeviceError("cannot open a window: " + missing + ". Use --headless, with --view-dir DIR to see something");
  view_ = std::make_unique<LiveView>(!options.headless, options.view_folder, options.view_every);
  if (view_->window_is_due()) draw();
  source_ = std::make_unique<OpenNISource>(settings.camera, camera_calibration(options), apps::log_to_stderr());
  status_ = source_->status();
  if (!options.record_folder.empty()) recording_ = std::make_unique<RecordingThread>(options.record_folder);
  if (options.record_only) reader_ = std::make_unique<RecordingReader>(*source_, *recording_, options.num_frames);
}

int LiveRun::run() {
  bool is_bug = false;
  try {
    loop();
  } catch (const std::exception& error) {  // what was reconstructed until then shall not be lost
    is_bug = dynamic_cast<const Error*>(&error) == nullptr;
    ended_by_ = "error";
    errors_.emplace_back(error.what());
    apps::log_error(error.what());
  }
  save_all();
  if (is_bug) return apps::kBug;
  if (!errors_.empty()) return apps::kUserError;
  return ended_by_ == "interrupt" ? apps::kInterrupted : apps::kSuccess;
}

void LiveRun::loop() {
  since_start_ = Stopwatch();
  FrameSource& frames = reader_ != nullptr ? static_cast<FrameSource&>(*reader_) : *source_;
  while (true) {
    press_scripted_keys();
    if (limit_is_reached()) return;
    const ReadStatus result = frames.read(next_frame_);
    if (result == ReadStatus::kEnd) {
      ended_by_ = "camera";
      return;
    }
    follow_camera();
    if (result == ReadStatus::kFrame) {
      if (!paused_) take(next_frame_);
      std::swap(frame_, next_frame_);
    }
    if (view_->window_is_due() || view_->file_is_due(num_taken_)) draw();
    obey(view_->take_key());
    if (view_->closed()) ended_by_ = "quit";
  }
}

bool LiveRun::limit_is_reached() {
  if (apps::interrupted()) ended_by_ = "interrupt";
  if (options_.num_frames > 0 && num_taken_ >= options_.num_frames) ended_by_ = "frames";
  if (options_.duration_s > 0.0 && since_start_.elapsed_ms() >= 1000.0 * options_.duration_s) ended_by_ = "duration";
  return !ended_by_.empty();
}

/// Records and reconstructs a frame: the one exactly if the other, so that the recording replays to the same trajectory.
void LiveRun::take(RgbdFrame& frame) {
  const bool to_be_recorded = recording_ != nullptr && reader_ == nullptr;
  if (to_be_recorded) round_depth_as_recorded(frame.depth);
  if (reconstruction_ != nullptr) register_colour(frame);  // as a replay would
  const bool recorded = to_be_recorded && recording_->add(frame);
  check_recording();
  if (to_be_recorded && !recorded && !recording_failed_) return;  // the disk is too slow: dropped, and counted
  num_taken_ = reader_ != nullptr ? reader_->num_taken() : num_taken_ + 1;
  if (reconstruction_ == nullptr) return;
  const FusionFrameResult result = reconstruction_->process(frame.view());
  monitor_->add(reconstruction_->pipeline(), result, event_);
  event_ = false;
  const std::string news = log_.add(frame.timestamp_s, result);
  if (!news.empty()) say(news);
  guide_.add(status_.num_pairs, status_.num_skipped, result);
  if (guide_.is_short_of_time() && !is_hurried_) hurry();
  if (guide_.start_has_failed()) reset("lost before there was a map to find it by: a new scene begins");
}

/// Time is short: the view costs less from now on.
void LiveRun::hurry() {
  is_hurried_ = true;
  monitor_->set_detail(apps::ModelDetail::kCoarse);
  apps::log_warning(guide_.advice().back());
}

void LiveRun::check_recording() {
  if (recording_ == nullptr || recording_failed_) return;
  const std::string error = recording_->progress().error;
  recording_failed_ = !error.empty();
  if (recording_failed_) say("recording has ended: " + error);
}

/// Tells what the camera does. After an unplug it may be anywhere, which is for the pipeline to find out, as it will in a replay.
void LiveRun::follow_camera() {
  status_ = source_->status();
  if (status_.state != OpenNIState::kStreaming) notice_ = status_.message;
  if (status_.num_reopened == num_reopened_) return;
  num_reopened_ = status_.num_reopened;
  event_ = true;
  say("the camera is back");
}

void LiveRun::press_scripted_keys() {
  while (!keys_.empty() && keys_.front().frame <= num_taken_) {
    obey(keys_.front().key);
    keys_.erase(keys_.begin());
  }
}

void LiveRun::obey(int key) {
  if (key == 'q' || key == kEscape) ended_by_ = "quit";
  if (key == 'h') show_help_ = !show_help_;
  if (key == ' ') {
    paused_ = !paused_;
    if (reader_ != nullptr) reader_->set_paused(paused_);
    say(paused_ ? "paused" : "going on");
  }
  if (reconstruction_ == nullptr) return;
  try {
    if (key == 'r') reset("forgotten; a new scene begins");
    if (key == 'l') {
      reconstruction_->force_loss();
      event_ = true;
      say("tracking of the next frame fails");
    }
    if (key == 't') {
      reconstruction_->set_relocalises(!reconstruction_->relocalises());
      say(reconstruction_->relocalises() ? "relocaliser on" : "relocaliser off: a lost camera is found only where it was last seen");
    }
    if (key == 'm') save_mesh(options_.save_mesh.empty() ? default_name(".ply") : options_.save_mesh);
    if (key == 's') save_scene(options_.save_scene.empty() ? default_name(".scene") : options_.save_scene);
    if (key == 'o') {
      scene_path_.empty() ? say("no scene to go on with: save one with S first, or start with --load-scene") : load_scene(scene_path_);
    }
  } catch (const FileError& error) {  // a full disk, say, is no reason to end
    apps::log_error(error.what());
    notice_ = error.what();
  }
}

void LiveRun::reset(const std::string& notice) {
  reconstruction_->reset();
  begin_world(false);
  say(notice);
}

void LiveRun::begin_world(bool is_loaded) {
  monitor_->clear();
  log_.begin_world();
  guide_.begin_world(is_loaded);
}

std::vector<SettingText> LiveRun::provenance() const {
  std::vector<SettingText> provenance{{"program", "reconstruct_live"},
                                      {"source", camera_name(status_.device) + ", " + status_.device.uri},
                                      {"frames", std::to_string(log_.num_frames())}};
  if (!loaded_scene_.empty()) provenance.push_back({"continues", loaded_scene_});
  return provenance;
}

void LiveRun::save_scene(const std::string& path) {
  reconstruction_->save(path, provenance());
  scene_path_ = path;
  say("saved the scene as " + path);
}

void LiveRun::load_scene(const std::string& path) {
  try {
    reconstruction_->load(path);
  } catch (const OtherSceneSettings& error) {
    std::string remedy;
    for (const SettingText& setting : error.settings()) remedy += " --set " + setting.path + "=" + setting.text;
    throw FileError(error.what() + (". To go on with it, give" + remedy));
  }
  scene_path_ = loaded_scene_ = path;
  begin_world(true);
  monitor_->add_map(extract_mesh(reconstruction_->pipeline().volume()));
  if (reconstruction_->pipeline().state() == RecoveryState::kLost) log_.begin_lost();
  say("going on with the scene of " + path + ": looking for the camera in it");
}

void LiveRun::save_mesh(const std::string& path) {
  write_ply(path, extract_mesh(reconstruction_->pipeline().volume()));
  say("saved the surface as " + path);
}

void LiveRun::say(const std::string& notice) {
  notice_ = notice;
  apps::log_info(notice);
}

std::string LiveRun::counters() const {
  std::string text = std::to_string(status_.num_skipped) + " frames skipped";
  if (recording_ == nullptr) return text;
  const RecordingThread::Progress progress = recording_->progress();
  return text + ", " + std::to_string(progress.num_written) + " recorded, " + std::to_string(progress.num_waiting) + " waiting, " +
         std::to_string(progress.num_dropped) + " dropped";
}

apps::ViewContents LiveRun::contents() {
  apps::ViewContents contents;
  if (monitor_ != nullptr) contents = monitor_->contents(frame_, reconstruction_->pipeline());
  contents.colour = frame_.colour;
  contents.depth_m = frame_.depth;
  contents.title = camera_name(status_.device);
  contents.frame_text = "frame " + std::to_string(num_taken_);
  if (reconstruction_ == nullptr) contents.state = apps::ViewState::kRecording;
  if (paused_) contents.state = apps::ViewState::kPaused;
  if (status_.state != OpenNIState::kStreaming) contents.state = apps::ViewState::kWaiting;
  contents.advice = guide_.advice();
  contents.notice = notice_;
  contents.warnings = apps::warnings();
  contents.counters = counters();
  contents.keys = live_keys();
  contents.show_help = show_help_;
  return contents;
}

void LiveRun::draw() {
  view_->show(contents(), num_taken_);
  if (monitor_ != nullptr) monitor_->add_drawing(view_->drawing_ms());
}

/// Saves one file; a failure is told, and does not keep the others from being saved.
template <class Save>
void LiveRun::attempt(const std::string& path, Save&& save) {
  if (path.empty()) return;
  try {
    save();
    saved_.push_back(path);
  } catch (const std::exception& error) {
    errors_.emplace_back(error.what());
    apps::log_error(error.what());
  }
}

void LiveRun::save_reconstruction() {
  const bool is_empty = reconstruction_->pipeline().volume().num_blocks() == 0;
  if (is_empty && !(options_.save_scene.empty() && options_.save_mesh.empty())) {
    apps::log_warning("nothing was reconstructed: no scene and no surface are saved");
  }
  if (!is_empty) {
    attempt(options_.save_scene, [&] { save_scene(options_.save_scene); });
    attempt(options_.save_mesh, [&] { save_mesh(options_.save_mesh); });
  }
  if (log_.trajectory().empty()) {
    if (!options_.save_trajectory.empty()) apps::log_warning("no frame of this scene has a pose: no trajectory is saved");
    return;
  }
  attempt(options_.save_trajectory, [&] { write_trajectory(options_.save_trajectory, log_.trajectory()); });
}

void LiveRun::save_all() {
  status_ = source_->status();  // before the camera runs on while files are written
  const OpenNIStatus status = status_;
  reader_.reset();
  if (recording_ != nullptr) attempt(options_.record_folder, [&] { recording_->finish(); });
  if (reconstruction_ != nullptr) save_reconstruction();
  attempt(options_.json, [&] {
    RunLog::Surroundings surroundings{ended_by_, status, recording_.get(), options_.record_folder, loaded_scene_, saved_, errors_, 0};
    if (reconstruction_ != nullptr) surroundings.num_blocks = reconstruction_->pipeline().volume().num_blocks();
    write_file_atomically(options_.json, log_.to_json(surroundings));
  });
  print_summary(status);
}

/// What the run came to, in one line each.
void LiveRun::print_summary(const OpenNIStatus& status) const {
  std::printf("camera: %lld pairs, %lld skipped, %lld images without a partner, reopened %lld times\n",
              static_cast<long long>(status.num_pairs), static_cast<long long>(status.num_skipped),
              static_cast<long long>(status.num_unmatched), static_cast<long long>(status.num_reopened));
  if (reconstruction_ != nullptr) {
    std::printf("reconstruction: %lld frames, %lld with a pose, lost %zu times, %d blocks\n", static_cast<long long>(log_.num_frames()),
                static_cast<long long>(log_.num_with_pose()), log_.losses().size(), reconstruction_->pipeline().volume().num_blocks());
  }
  if (recording_ == nullptr) return;
  const RecordingThread::Progress progress = recording_->progress();
  std::printf("recording: %d frames written, %d dropped\n", progress.num_written, progress.num_dropped);
}

}  // namespace foothold::live
