// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The adapter with types that have the members of a host's, and nothing else of it.
#include "foothold/infinitam/adapter.h"

#include <vector>

#include "foothold/base/error.h"
#include "foothold/frames/register_colour.h"
#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold::infinitam {
namespace {

/// Single precision over a few products.
constexpr float kTolerance = 1e-5F;

// NOLINTBEGIN(readability-identifier-naming): the names are the host's
enum HostDevice { HOST_CPU, HOST_GPU };

struct HostMatrix {
  float m[16];
};
struct HostSize {
  int x = 0;
  int y = 0;
};
struct HostPixel {
  unsigned char x, y, z, w;
};
template <class T>
struct HostImage {
  HostSize noDims;
  std::vector<T> cpu;
  std::vector<T> gpu;
  const T* GetData(HostDevice device) const { return device == HOST_CPU ? cpu.data() : gpu.data(); }
};
struct HostIntrinsics {
  struct {
    float fx, fy, px, py;
  } projectionParamsSimple;
};
struct HostCalibration {
  HostIntrinsics intrinsics_rgb;
  HostIntrinsics intrinsics_d;
  struct {
    HostMatrix calib;
  } trafo_rgb_to_depth;
};
template <class Calibration>
struct HostView {
  Calibration calib;
  HostImage<HostPixel>* rgb;
  HostImage<float>* depth;
};
struct HostPose {
  HostMatrix camera_from_world;
  const HostMatrix& GetM() const { return camera_from_world; }
  void SetM(const HostMatrix& matrix) { camera_from_world = matrix; }
};
struct HostTrackingState {
  HostPose* pose_d;
};

// NOLINTEND(readability-identifier-naming)

/// Remembers what it is given, and proposes what it is told to.
class FakeRelocaliser : public Relocaliser {
 public:
  void train(const Frame& frame, const SE3& world_from_camera) override {
    frames.push_back(frame);
    poses.push_back(world_from_camera);
  }
  std::vector<PoseEstimate> relocalise(const Frame& frame) override {
    frames.push_back(frame);
    return proposals;
  }
  void update() override { ++num_updates; }
  void reset() override { frames.clear(); }
  std::size_t state_bytes() const override { return 0; }
  float acceptance_threshold() const override { return 0.5F; }

  std::vector<Frame> frames;
  std::vector<SE3> poses;
  std::vector<PoseEstimate> proposals;
  int num_updates = 0;
};

SE3 random_transform(Random& random) { return test::random_motion(random, 1.5F, 1.5F); }

bool are_close(const SE3& a, const SE3& b) {
  return (a.rotation - b.rotation).norm() < kTolerance && (a.translation - b.translation).norm() < kTolerance;
}

struct Fixture {
  Fixture() {
    calibration.intrinsics_d.projectionParamsSimple = {585.0F, 586.0F, 320.0F, 240.0F};
    calibration.intrinsics_rgb.projectionParamsSimple = {525.0F, 526.0F, 321.0F, 241.0F};
    calibration.trafo_rgb_to_depth.calib = from_se3<HostMatrix>(depth_from_colour);
    depth.noDims = rgb.noDims = {4, 3};
    depth.cpu.assign(12, 1.5F);
    depth.gpu.assign(12, 2.5F);
    rgb.cpu.assign(12, {1, 2, 3, 255});
    rgb.gpu.assign(12, {4, 5, 6, 255});
    pose.camera_from_world = from_se3<HostMatrix>(camera_from_world);
  }

  Random random = test::test_random();
  SE3 depth_from_colour = random_transform(random);
  SE3 camera_from_world = random_transform(random);
  HostCalibration calibration;
  HostImage<float> depth;
  HostImage<HostPixel> rgb;
  HostPose pose;
  HostTrackingState state{&pose};
  FakeRelocaliser relocaliser;
};

TEST_CASE("to_se3: reads columns, and re-orthonormalises what has drifted") {
  Fixture fixture;
  const HostMatrix matrix = from_se3<HostMatrix>(fixture.camera_from_world);
  REQUIRE(matrix.m[1] == fixture.camera_from_world.rotation(1, 0));
  REQUIRE(matrix.m[13] == fixture.camera_from_world.translation.y());
  REQUIRE(matrix.m[15] == 1.0F);
  REQUIRE(are_close(to_se3(matrix), fixture.camera_from_world));
  HostMatrix drifted = matrix;
  for (int i = 0; i < 11; ++i) drifted.m[i] *= 1.001F;
  REQUIRE(is_rigid(to_se3(drifted), 1e-6F));
  REQUIRE(are_close(to_se3(drifted), fixture.camera_from_world));
  HostMatrix mirrored = matrix;
  for (int i = 0; i < 4; ++i) mirrored.m[i] = -mirrored.m[i];
  REQUIRE_THROWS_AS(to_se3(mirrored), ContractViolation);
  HostMatrix scaled = matrix;
  for (int i = 0; i < 11; ++i) scaled.m[i] *= 1000.0F;
  REQUIRE_THROWS_AS(to_se3(scaled), ContractViolation);
}

TEST_CASE("world_from_camera: is the inverse of what the host keeps, there and back") {
  Fixture fixture;
  REQUIRE(are_close(world_from_camera(fixture.state) * fixture.camera_from_world, SE3{}));
  const SE3 wanted = random_transform(fixture.random);
  set_world_from_camera(fixture.state, wanted);
  REQUIRE(are_close(world_from_camera(fixture.state), wanted));
  REQUIRE(are_close(to_se3(fixture.pose.camera_from_world), wanted.inverse()));
}

TEST_CASE("make_frame: points at the host's own images in the memory asked for") {
  Fixture fixture;
  const HostView<HostCalibration> view{fixture.calibration, &fixture.rgb, &fixture.depth};
  const Frame cpu = make_frame(view, HOST_CPU, MemoryKind::kHost, 7);
  REQUIRE(describe_frame_error(cpu).empty());
  REQUIRE(cpu.depth.data == fixture.depth.cpu.data());
  REQUIRE(cpu.depth.width == 4);
  REQUIRE(cpu.depth.height == 3);
  REQUIRE(cpu.colour.bytes_per_pixel == 4);
  REQUIRE(cpu.colour(3, 2).g == 2);
  REQUIRE(cpu.index == 7);
  const Frame gpu = make_frame(view, HOST_GPU, MemoryKind::kCuda);
  REQUIRE(gpu.depth.data == fixture.depth.gpu.data());
  REQUIRE(gpu.depth.memory == MemoryKind::kCuda);
  REQUIRE(gpu.colour.memory == MemoryKind::kCuda);
}

TEST_CASE("make_frame: takes both cameras' calibration, from a member or a pointer") {
  Fixture fixture;
  const HostView<HostCalibration> by_value{fixture.calibration, &fixture.rgb, &fixture.depth};
  const HostView<const HostCalibration*> by_pointer{&fixture.calibration, &fixture.rgb, &fixture.depth};
  for (const Frame& frame : {make_frame(by_value, HOST_CPU, MemoryKind::kHost), make_frame(by_pointer, HOST_CPU, MemoryKind::kHost)}) {
    REQUIRE(frame.calibration.depth.fy == 586.0F);
    REQUIRE(frame.calibration.depth.cx == 320.0F);
    REQUIRE(frame.calibration.colour.fx == 525.0F);
    REQUIRE(frame.calibration.colour.cy == 241.0F);
    REQUIRE(are_close(frame.calibration.depth_from_colour, fixture.depth_from_colour));
  }
}

TEST_CASE("Adapter: trains with the pose turned round, and counts frames") {
  Fixture fixture;
  const HostView<HostCalibration> view{fixture.calibration, &fixture.rgb, &fixture.depth};
  Adapter adapter(fixture.relocaliser, HOST_CPU, MemoryKind::kHost);
  adapter.train(view, fixture.state);
  adapter.train(view, fixture.state);
  adapter.update();
  REQUIRE(fixture.relocaliser.num_updates == 1);
  REQUIRE(fixture.relocaliser.frames.size() == 2);
  REQUIRE(fixture.relocaliser.frames[1].index == 1);
  REQUIRE(are_close(fixture.relocaliser.poses[0], fixture.camera_from_world.inverse()));
  adapter.reset();
  REQUIRE(fixture.relocaliser.frames.empty());
}

TEST_CASE("Adapter: colour that the host has not registered is registered, whatever its size") {
  Fixture fixture;
  fixture.calibration.trafo_rgb_to_depth.calib = from_se3<HostMatrix>(SE3{});
  fixture.calibration.intrinsics_rgb.projectionParamsSimple = {1170.0F, 1172.0F, 640.5F, 480.5F};  // twice that of depth
  fixture.rgb.noDims = {8, 6};
  fixture.rgb.cpu.clear();
  for (unsigned char v = 0; v < 6; ++v) {
    for (unsigned char u = 0; u < 8; ++u)
      fixture.rgb.cpu.push_back({static_cast<unsigned char>(10 * u), static_cast<unsigned char>(20 * v), 7, 255});
  }
  const HostView<HostCalibration> view{fixture.calibration, &fixture.rgb, &fixture.depth};
  Adapter adapter(fixture.relocaliser, HOST_CPU, MemoryKind::kHost);
  adapter.train(view, fixture.state);
  adapter.relocalise(view, fixture.state);
  for (const Frame& frame : fixture.relocaliser.frames) {
    REQUIRE(describe_frame_error(frame).empty());
    REQUIRE(is_registered(frame));
    REQUIRE(frame.depth.data == fixture.depth.cpu.data());
  }
  // A pixel of depth lies between four of colour.
  const Rgb8 colour = fixture.relocaliser.frames.back().colour(1, 1);
  REQUIRE(static_cast<int>(colour.r) == 25);
  REQUIRE(static_cast<int>(colour.g) == 50);
}

TEST_CASE("Adapter: hands over the host's own images where they are registered") {
  Fixture fixture;
  fixture.calibration.trafo_rgb_to_depth.calib = from_se3<HostMatrix>(SE3{});
  fixture.calibration.intrinsics_rgb = fixture.calibration.intrinsics_d;
  const HostView<HostCalibration> view{fixture.calibration, &fixture.rgb, &fixture.depth};
  Adapter adapter(fixture.relocaliser, HOST_CPU, MemoryKind::kHost);
  adapter.train(view, fixture.state);
  REQUIRE(fixture.relocaliser.frames[0].colour.data == &fixture.rgb.cpu.data()->x);
  Adapter on_device(fixture.relocaliser, HOST_GPU, MemoryKind::kCuda);
  on_device.train(view, fixture.state);
  REQUIRE(fixture.relocaliser.frames[1].colour.data == &fixture.rgb.gpu.data()->x);
}

TEST_CASE("Adapter: writes a confident proposal into the tracking state, and leaves it alone otherwise") {
  Fixture fixture;
  const HostView<HostCalibration> view{fixture.calibration, &fixture.rgb, &fixture.depth};
  Adapter adapter(fixture.relocaliser, HOST_CPU, MemoryKind::kHost);
  REQUIRE_FALSE(adapter.relocalise(view, fixture.state).has_value());
  const SE3 best = random_transform(fixture.random);
  fixture.relocaliser.proposals = {{best, 0.49F}, {SE3{}, 0.1F}};
  REQUIRE_FALSE(adapter.relocalise(view, fixture.state).has_value());
  REQUIRE(are_close(world_from_camera(fixture.state), fixture.camera_from_world.inverse()));
  fixture.relocaliser.proposals[0].confidence = 0.5F;
  REQUIRE(adapter.relocalise(view, fixture.state).value().confidence == 0.5F);
  REQUIRE(are_close(world_from_camera(fixture.state), best));
}

}  // namespace
}  // namespace foothold::infinitam
