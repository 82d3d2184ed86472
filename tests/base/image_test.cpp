// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/image.h"

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

TEST_CASE("Image: rows follow one another without padding") {
  Image<int> image(3, 2, 7);
  REQUIRE(image.size() == 6);
  REQUIRE(image(2, 1) == 7);
  image(1, 1) = 9;
  REQUIRE(image.data()[4] == 9);
  REQUIRE(image.view()(1, 1) == 9);
  REQUIRE(Image<int>().empty());
  REQUIRE(Image<int>(0, 5).empty());
}

TEST_CASE("Image: refuses negative sizes") {
  REQUIRE_THROWS_AS(Image<int>(-1, 2), ContractViolation);
  REQUIRE_THROWS_AS(Image<int>(2, -1), ContractViolation);
}

TEST_CASE("ImageView: knows its bounds and adds const") {
  Image<float> image(4, 3);
  const ImageView<const float> view = image.view();
  REQUIRE(view.memory == MemoryKind::kHost);
  REQUIRE(view.size() == 12);
  REQUIRE(view.contains(0, 0));
  REQUIRE(view.contains(3, 2));
  REQUIRE_FALSE(view.contains(4, 2));
  REQUIRE_FALSE(view.contains(3, 3));
  REQUIRE_FALSE(view.contains(-1, 0));
  REQUIRE_FALSE(view.contains(0, -1));
  REQUIRE_FALSE(view.empty());
  REQUIRE(ImageView<float>{}.empty());
  REQUIRE((ImageView<float>{image.data(), 0, 3, MemoryKind::kHost}).empty());
}

TEST_CASE("ColourView: reads RGB and RGBA") {
  Image<Rgb8> rgb(2, 2);
  rgb(1, 1) = {1, 2, 3};
  const Rgb8 pixel = colour_view(rgb)(1, 1);
  REQUIRE(pixel.r == 1);
  REQUIRE(pixel.g == 2);
  REQUIRE(pixel.b == 3);

  const std::uint8_t rgba[] = {0, 0, 0, 255, 4, 5, 6, 255};
  const ColourView view{rgba, 2, 1, 4, MemoryKind::kHost};
  REQUIRE(view(1, 0).r == 4);
  REQUIRE(view(1, 0).b == 6);
  REQUIRE(ColourView{}.empty());
}

}  // namespace
}  // namespace foothold
