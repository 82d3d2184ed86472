// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The branches of a regression forest: what is kept when a forest moves to a new scene. Reference: [Cavallari2017] Sec. 2.2.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "foothold/base/platform.h"
#include "foothold/base/span.h"
#include "foothold/relocalisation/settings.h"

namespace foothold {

/// What a feature compares at a pixel and at its displaced partner.
enum class FeatureChannel : std::int32_t { kDepth = 0, kRed = 1, kGreen = 2, kBlue = 3 };

/// The parameters Omega of one feature: its channel and its offset delta. The partner lies at p + delta / D(p).
/// Offsets are in pixels times metres for a camera with a focal length of kReferenceFocalPx; other cameras scale them by their own.
struct ForestFeature {
  FeatureChannel channel = FeatureChannel::kDepth;  ///< what is compared at the two pixels
  float offset_u_px_m = 0.0F;                       ///< along rows [px m]
  float offset_v_px_m = 0.0F;                       ///< along columns [px m]
};
static_assert(sizeof(ForestFeature) == 12, "read from files and by kernels");

/// The focal length [px] that feature offsets refer to: the 7-Scenes camera's.
inline constexpr float kReferenceFocalPx = 585.0F;

/// A branch: an example goes right iff its feature is at least the threshold. Children stand side by side, as in [Sharp2008].
struct ForestNode {
  std::int32_t left_child = 0;  ///< index of the left child node, whose right sibling follows; ~leaf (negative) for a leaf
  std::uint16_t feature = 0;    ///< index into the forest's features
  std::int16_t threshold = 0;   ///< [mm] for depth, [grey levels] for colour
};
static_assert(sizeof(ForestNode) == 8, "read from files and by kernels");

/// What kernels see of a forest: pointers into memory of their device.
struct ForestView {
  const ForestFeature* features = nullptr;  ///< all that nodes name
  const ForestNode* nodes = nullptr;        ///< those of all trees
  const std::int32_t* roots = nullptr;      ///< node index of each tree's root
  int num_trees = 0;                        ///< number of trees
  int num_leaves = 0;                       ///< of all trees; leaf numbers do not repeat between trees
};

/// What a forest may have at most: files and settings ask for memory and time in proportion.
inline constexpr int kMaxForestTrees = 32;
inline constexpr int kMaxForestDepth = 32;                 ///< splits on a path from root to leaf
inline constexpr int kMaxForestLeaves = 1 << 20;           ///< of all trees
inline constexpr int kMaxForestFeatures = 1 << 16;         ///< that nodes choose from
inline constexpr int kMaxForestProvenanceBytes = 1 << 20;  ///< of the text that says where a forest comes from

/// An immutable forest in host memory.
class Forest {
 public:
  /// @throws InvalidSettings if a node, feature or leaf reference is out of range, a node has two parents or none, leaves are not numbered
  /// from 0 without gaps, the forest is empty, or it has more of something than the limits above.
  Forest(std::vector<ForestFeature> features, std::vector<ForestNode> nodes, std::vector<std::int32_t> roots, std::string provenance);

  /// All features that nodes name.
  const std::vector<ForestFeature>& features() const { return features_; }
  /// The nodes of all trees.
  const std::vector<ForestNode>& nodes() const { return nodes_; }
  /// The index of each tree's root among the nodes.
  const std::vector<std::int32_t>& roots() const { return roots_; }
  /// Number of trees.
  int num_trees() const { return static_cast<int>(roots_.size()); }
  /// Leaves of all trees.
  int num_leaves() const { return num_leaves_; }
  /// Splits on the longest path of any tree.
  int depth() const { return depth_; }
  /// Where the forest comes from: settings, seed and data, as text.
  const std::string& provenance() const { return provenance_; }
  /// FNV-1a over features, nodes and roots: names the branches in files that refer to them.
  std::uint64_t fingerprint() const;
  /// What kernels on the host see of it, while it lives.
  ForestView view() const;

 private:
  std::vector<ForestFeature> features_;
  std::vector<ForestNode> nodes_;
  std::vector<std::int32_t> roots_;
  std::string provenance_;
  int num_leaves_ = 0;
  int depth_ = 0;
};

/// Complete trees of random splits that have seen no data. A function of the settings alone. @throws InvalidSettings
Forest make_random_forest(const RandomForestSettings& settings);

/// The forest that Foothold uses unless told otherwise: data/default.forest, trained on rendered rooms (docs/forest-training.md). It is
/// part of the library; no file is read.
Forest default_forest();

/// Writes a forest in Foothold's binary format (docs/forest-format.md). @throws FileError
void write_forest(std::ostream& stream, const Forest& forest);
/// Reads what write_forest() wrote. `name` stands for the stream in messages.
/// @throws FileError for a wrong magic, version or checksum, a truncated stream, or an inconsistent forest.
Forest read_forest(std::istream& stream, const std::string& name);

/// Replaces the file once the new one is complete (AtomicFile), so that the old one stays whole if anything fails. @throws FileError
void save_forest(const std::string& path, const Forest& forest);
/// @throws FileError naming the file, the value found and what was expected.
Forest load_forest(const std::string& path);

}  // namespace foothold
