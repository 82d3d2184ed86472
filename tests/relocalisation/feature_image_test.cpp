// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "features/leaf_lookup.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// A frame of noise with holes of every kind, in colour with 3 or 4 bytes a pixel.
struct NoiseFrame {
  NoiseFrame(Random& random, int width, int height, int bytes_per_pixel) : depth(width, height) {
    const float holes[] = {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 33.0F};
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const std::uint32_t kind = random.below(8);
      depth.data()[i] = kind < 5 ? holes[kind] : random.uniform(0.3F, 6.0F);
    }
    // A region without any depth, larger than a block.
    for (int v = 8; v < 24 && v < height; ++v) {
      for (int u = 8; u < 24 && u < width; ++u) depth(u, v) = 0.0F;
    }
    colour.resize(depth.size() * static_cast<std::size_t>(bytes_per_pixel));
    for (std::uint8_t& byte : colour) byte = static_cast<std::uint8_t>(random.below(256));
    frame.depth = depth.view();
    frame.colour = {colour.data(), width, height, bytes_per_pixel, MemoryKind::kHost};
    frame.calibration.depth = {static_cast<float>(width) * 0.9F, static_cast<float>(width) * 0.9F, static_cast<float>(width) / 2.0F,
                               static_cast<float>(height) / 2.0F};
    frame.calibration.colour = frame.calibration.depth;
  }

  Image<float> depth;
  std::vector<std::uint8_t> colour;
  Frame frame;
};

/// One channel of one block by its definition: the mean of what is valid, rounded half up.
int expected_channel(const NoiseFrame& noise, int block_u, int block_v, int downscale, int channel) {
  long sum = 0;
  long count = 0;
  for (int v = block_v * downscale; v < (block_v + 1) * downscale; ++v) {
    for (int u = block_u * downscale; u < (block_u + 1) * downscale; ++u) {
      if (channel == 0) {
        const float d = noise.depth(u, v);
        if (!(d > 0.0F && d < 32.0F)) continue;
        sum += std::lround(d * 1000.0F);
      } else {
        const auto pixel = static_cast<std::size_t>(v * noise.depth.width() + u);
        sum += noise.colour[pixel * static_cast<std::size_t>(noise.frame.colour.bytes_per_pixel) + static_cast<std::size_t>(channel - 1)];
      }
      ++count;
    }
  }
  return count == 0 ? 0 : static_cast<int>((2 * sum + count) / (2 * count));
}

TEST_CASE("FeatureImage: blocks hold the mean of their valid depths and of their colours") {
  Random random = test::test_random();
  const Context context;
  for (const int bytes_per_pixel : {3, 4}) {
    for (const int downscale : {1, 2, 4, 7, 9}) {
      const NoiseFrame noise(random, 67, 45, bytes_per_pixel);  // the last blocks are incomplete and left out
      FeatureImage image(context);
      image.compute(context, noise.frame, downscale);
      const FeatureImageView view = image.view();
      REQUIRE(view.width == 67 / downscale);
      REQUIRE(view.height == 45 / downscale);
      REQUIRE(view.offset_scale_px_mm == Approx(1000.0 * 67 * 0.9 / 585.0 / downscale));
      bool any_hole = false;
      for (int v = 0; v < view.height; ++v) {
        for (int u = 0; u < view.width; ++u) {
          for (int channel = 0; channel < 4; ++channel) {
            REQUIRE(view.pixels[v * view.width + u].channels[channel] == expected_channel(noise, u, v, downscale, channel));
          }
          any_hole = any_hole || view.pixels[v * view.width + u].depth_mm() == 0;
        }
      }
      REQUIRE(any_hole);
    }
  }
}

TEST_CASE("FeatureImage: in another light colours are multiplied, at most to white, and depth is as it was") {
  Random random = test::test_random();
  const NoiseFrame noise(random, 64, 48, 3);
  const Context context;
  FeatureImage image(context);
  image.compute(context, noise.frame, 4);
  for (const float gain : {0.45F, 1.0F, 2.2F}) {
    FeatureImage relit(context);
    relit.relight(context, image, gain);
    const FeatureImageView from = image.view();
    const FeatureImageView to = relit.view();
    REQUIRE((to.width == from.width && to.height == from.height && to.offset_scale_px_mm == from.offset_scale_px_mm));
    REQUIRE(relit.downscale() == image.downscale());
    for (int i = 0; i < from.width * from.height; ++i) {
      REQUIRE(to.pixels[i].depth_mm() == from.pixels[i].depth_mm());
      for (int k = 1; k < 4; ++k) {
        const double expected = std::min(255.0, static_cast<double>(gain) * from.pixels[i].channels[k]);
        REQUIRE(std::abs(to.pixels[i].channels[k] - expected) <= 0.501);
      }
    }
  }
}

/// The leaf that one pixel reaches in one tree, by the definition of features and splits.
std::uint32_t expected_leaf(const FeatureImageView& image, double scale_px_mm, int downscale, const Forest& forest,
                            const SampledPixel& pixel, std::int32_t root) {
  const int u = std::min(pixel.u / downscale, image.width - 1);
  const int v = std::min(pixel.v / downscale, image.height - 1);
  const FeaturePixel& centre = image.pixels[v * image.width + u];
  if (!(pixel.depth_m > 0.0F) || centre.depth_mm() == 0) return static_cast<std::uint32_t>(forest.num_leaves());
  ForestNode node = forest.nodes()[static_cast<std::size_t>(root)];
  while (node.left_child >= 0) {
    const ForestFeature& feature = forest.features()[node.feature];
    const double du = static_cast<double>(feature.offset_u_px_m) * scale_px_mm / centre.depth_mm();
    const double dv = static_cast<double>(feature.offset_v_px_m) * scale_px_mm / centre.depth_mm();
    const int partner_u = std::min(std::max(u + static_cast<int>(std::floor(du + 0.5)), 0), image.width - 1);
    const int partner_v = std::min(std::max(v + static_cast<int>(std::floor(dv + 0.5)), 0), image.height - 1);
    const auto channel = static_cast<std::size_t>(feature.channel);
    const int value = centre.channels[channel] - image.pixels[partner_v * image.width + partner_u].channels[channel];
    node = forest.nodes()[static_cast<std::size_t>(node.left_child + (value >= node.threshold ? 1 : 0))];
  }
  return static_cast<std::uint32_t>(~node.left_child);
}

TEST_CASE("FeatureImage: a copy keeps its pixels when its source goes on to another frame, or ends") {
  Random random = test::test_random();
  const NoiseFrame first(random, 64, 48, 3);
  const NoiseFrame second(random, 64, 48, 3);
  const Context context;
  auto source = std::make_unique<FeatureImage>(context);
  source->compute(context, first.frame, 4);
  const FeatureImageView of_source = source->view();
  const std::vector<FeaturePixel> expected(of_source.pixels, of_source.pixels + of_source.width * of_source.height);
  FeatureImage copy = *source;
  FeatureImage assigned(context);
  assigned = *source;
  const auto require_expected = [&](const FeatureImageView& view) {
    REQUIRE(view.width == 16);
    REQUIRE(view.height == 12);
    REQUIRE((std::memcmp(view.pixels, expected.data(), expected.size() * sizeof(FeaturePixel)) == 0));
  };
  source->compute(context, second.frame, 4);
  require_expected(copy.view());
  require_expected(assigned.view());
  source.reset();
  require_expected(FeatureImage(std::move(copy)).view());
}

TEST_CASE("find_leaves: each pixel reaches in each tree the leaf that the definition says") {
  Random random = test::test_random();
  RandomForestSettings settings;
  settings.depth = 9;
  const Forest forest = make_random_forest(settings);
  for (const int num_threads : {1, 4}) {
    ContextOptions options;
    options.num_threads = num_threads;
    const Context context(options);
    for (const int downscale : {1, 3, 4}) {
      const NoiseFrame noise(random, 67, 45, 3 + downscale % 2);
      FeatureImage image(context);
      image.compute(context, noise.frame, downscale);
      std::vector<SampledPixel> pixels;
      for (int v = 0; v < 45; ++v) {
        for (int u = 0; u < 67; ++u) {
          pixels.push_back({static_cast<std::int16_t>(u), static_cast<std::int16_t>(v), is_valid_depth(noise.depth(u, v)) ? 1.0F : 0.0F});
        }
      }
      pixels.resize(pixels.size() - 5);  // not a multiple of any vector's width
      const auto num_trees = static_cast<std::size_t>(forest.num_trees());
      std::vector<std::uint32_t> leaves(pixels.size() * num_trees);
      find_leaves(context, image, forest.view(), Span<const SampledPixel>(pixels), Span<std::uint32_t>(leaves));
      std::size_t num_different = 0;
      std::size_t num_without = 0;
      const double scale_px_mm = 1000.0 * static_cast<double>(noise.frame.calibration.depth.fx) / 585.0 / downscale;
      for (std::size_t tree = 0; tree < num_trees; ++tree) {
        for (std::size_t i = 0; i < pixels.size(); ++i) {
          const std::uint32_t expected = expected_leaf(image.view(), scale_px_mm, downscale, forest, pixels[i], forest.roots()[tree]);
          const std::uint32_t found = leaves[tree * pixels.size() + i];
          REQUIRE((found == static_cast<std::uint32_t>(forest.num_leaves())) ==
                  (expected == static_cast<std::uint32_t>(forest.num_leaves())));
          num_different += found != expected ? 1 : 0;
          num_without += expected == static_cast<std::uint32_t>(forest.num_leaves()) ? 1 : 0;
        }
      }
      REQUIRE(num_without > 100);
      REQUIRE(num_without < leaves.size() * 9 / 10);
      // A partner that lies exactly between two pixels may be rounded either way in single precision: less than one path in a thousand.
      REQUIRE(num_different <= leaves.size() / 1000);
    }
  }
}

TEST_CASE("evaluate_feature: partners outside the image are clamped to its border") {
  std::vector<FeaturePixel> pixels(12);
  for (int i = 0; i < 12; ++i) {
    pixels[static_cast<std::size_t>(i)].channels[0] = static_cast<std::int16_t>(1000 + i);
    pixels[static_cast<std::size_t>(i)].channels[2] = static_cast<std::int16_t>(10 * i);
  }
  const FeatureImageView image{pixels.data(), 4, 3, 1000.0F};
  const auto value = [&](FeatureChannel channel, float du, float dv) { return evaluate_feature(image, 1, 1, 1.0F, {channel, du, dv}); };
  REQUIRE(value(FeatureChannel::kDepth, 0.0F, 0.0F) == 0);
  REQUIRE(value(FeatureChannel::kDepth, 1.0F, 0.0F) == -1);
  REQUIRE(value(FeatureChannel::kGreen, 0.0F, 1.0F) == -40);
  REQUIRE(value(FeatureChannel::kDepth, -100.0F, 0.0F) == 1);     // (0, 1)
  REQUIRE(value(FeatureChannel::kDepth, 100.0F, 0.0F) == -2);     // (3, 1)
  REQUIRE(value(FeatureChannel::kDepth, 0.0F, -100.0F) == 4);     // (1, 0)
  REQUIRE(value(FeatureChannel::kGreen, 100.0F, 100.0F) == -60);  // (3, 2)
  REQUIRE(value(FeatureChannel::kDepth, 0.49F, -0.49F) == 0);
  REQUIRE(value(FeatureChannel::kDepth, -0.51F, 0.0F) == 1);
}

TEST_CASE("scaled_to_width: sizes shrink and grow with the frame, but never below a pixel") {
  REQUIRE(scaled_to_width(8, 640) == 8);
  REQUIRE(scaled_to_width(8, 320) == 4);
  REQUIRE(scaled_to_width(8, 1280) == 16);
  REQUIRE(scaled_to_width(4, 100) == 1);
  REQUIRE(scaled_to_width(1, 64) == 1);
}

}  // namespace
}  // namespace foothold
