// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Analytic rooms: surfaces with closed forms, so that depth, poses and distances to the truth are exact.
///
/// World frame: right-handed, metres, z up, the floor at z = 0, the middle of the room at x = y = 0.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "foothold/base/se3.h"

namespace foothold {

/// What a primitive looks like in its own frame, whose origin is its centre.
enum class Shape {
  kRectangle,  ///< the patch |x| <= half_size.x, |y| <= half_size.y of the plane z = 0, seen from both sides
  kBox,        ///< |x|, |y|, |z| within half_size
  kSphere,     ///< radius half_size.x
  kCylinder,   ///< capped; axis z, radius half_size.x, |z| <= half_size.z
};

/// The pattern on a surface, a function of the place on the surface alone.
enum class Texture {
  kPlain,     ///< one colour with the faintest of stains
  kPlaster,   ///< fractal noise: plaster, concrete, carpet
  kWood,      ///< planks with grain along u
  kTiles,     ///< square tiles, each of its own tint, with accent-coloured joints
  kChecker,   ///< squares of colour and accent
  kStripes,   ///< stripes of irregular width along v
  kText,      ///< lines of print
  kPoster,    ///< a picture of bold shapes with a caption, filling the surface
  kSpine,     ///< the back of a book: bands and a title, filling the surface
  kFabric,    ///< weave with folds
  kSpeckle,   ///< granite
  kBricks,    ///< running bond with accent-coloured mortar
  kKeyboard,  ///< rows of keys
  kScreen,    ///< windows on a display, filling the surface
  kFoliage,   ///< light and dark blotches of leaf size
};

/// How a surface reflects.
struct Material {
  Texture texture = Texture::kPlain;         ///< the pattern
  Eigen::Vector3f colour{0.7F, 0.7F, 0.7F};  ///< red, green, blue in [0, 1]
  Eigen::Vector3f accent{0.3F, 0.3F, 0.3F};  ///< the pattern's second colour
  float scale_m = 0.1F;                      ///< size of the pattern's largest element
  float contrast = 0.3F;                     ///< strength of the pattern in [0, 1]
  float infrared_return = 1.0F;              ///< how reliably a depth camera sees it: 1 matt, 0 never (glass)
};

/// A simple shape of one material.
struct Primitive {
  Shape shape = Shape::kBox;                              ///< the kind of shape
  SE3 world_from_local;                                   ///< its pose in the room
  Eigen::Vector3f half_size_m = Eigen::Vector3f::Ones();  ///< along the axes of the shape, from its centre [m]
  Material material;                                      ///< what it is made of
  std::uint32_t seed = 0;                                 ///< varies the pattern; equal seeds give equal patterns
  /// The number of the piece of furniture that it is a part of, or kFixture for what belongs to the building.
  std::int32_t piece = kFixture;
  static constexpr std::int32_t kFixture = -1;  ///< the piece of walls, floor, ceiling and the like
};

/// A lamp that shines equally in all directions and casts no shadows.
struct PointLight {
  Eigen::Vector3f position_world = Eigen::Vector3f::Zero();  ///< where it shines from [m]
  Eigen::Vector3f intensity = Eigen::Vector3f::Ones();       ///< light on a facing surface at distance d [m]: intensity / (0.5 + d^2)
};

/// A scene, and where a camera may go in it.
struct Room {
  std::string name;                                            ///< as SyntheticSequenceSettings::room has it
  std::vector<Primitive> primitives;                           ///< all that there is in it
  std::vector<PointLight> lights;                              ///< all lamps
  Eigen::Vector3f ambient = Eigen::Vector3f::Constant(0.45F);  ///< light from everywhere: red, green, blue
  Eigen::Vector3f low_world{-2.0F, -2.0F, 0.0F};               ///< lowest corner of the room's shell
  Eigen::Vector3f high_world{2.0F, 2.0F, 2.5F};                ///< highest corner of the room's shell
  Eigen::Vector3f eye_low_world{-1.0F, -1.0F, 1.2F};           ///< the lowest place of the camera's centre [m]
  Eigen::Vector3f eye_high_world{1.0F, 1.0F, 1.8F};            ///< the camera's centre stays within about this box
  std::vector<Eigen::Vector3f> targets_world;                  ///< what a person would point the camera at
  std::uint64_t seed = 0;                                      ///< decides the trajectories
  std::int32_t num_pieces = 0;                                 ///< of furniture; Primitive::piece is below it
};

/// The names of the test rooms. Training rooms, "training-0", "training-1" and so on, come on top without limit.
std::vector<std::string> synthetic_room_names();

/// Builds a room by name.
///
/// @throws InvalidSettings listing the known rooms for any other name.
/// Determinism: a function of the name alone.
Room make_room(const std::string& name);

/// The distance [m] from a point to the nearest surface; infinity for a room without primitives.
///
/// Exact for points outside all solids. Surfaces buried inside other solids count too.
float distance_to_surface(const Room& room, const Eigen::Vector3f& point_world);

/// The distance [m] from a point to the surface of one primitive, exact on both sides.
float distance_to_surface(const Primitive& primitive, const Eigen::Vector3f& point_world);

}  // namespace foothold
