// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Images on disk.
#pragma once

#include <cstdint>
#include <string>

#include "foothold/base/image.h"

namespace foothold {

/// Reads a PNG or JPEG image of 8 bits a channel as colour; grey images become grey colours.
/// @throws FileError if the file is missing, not an image, cut short or damaged, of more bits, or of more than 32 Mi pixels.
Image<Rgb8> read_rgb_image(const std::string& path);

/// Reads a PNG image of one 16-bit channel, as depth is stored. @throws FileError as read_rgb_image(), and for any other kind of pixel.
Image<std::uint16_t> read_u16_image(const std::string& path);

/// Writes a PNG image; an existing file is replaced only when the new one is complete. @throws FileError
void write_png(const std::string& path, const Image<Rgb8>& image);
/// The same for 16 bits.
void write_png(const std::string& path, const Image<std::uint16_t>& image);
/// Writes a depth image [m] for people to look at: colourise_depth() from 0 to 5 m. To store depth, write 16-bit millimetres.
void write_png(const std::string& path, const Image<float>& depth_m);

/// Paints depth [m] with a perceptually ordered colour map, near bright and far dark; black where there is no measurement.
/// @pre near_m < far_m
Image<Rgb8> colourise_depth(const Image<float>& depth_m, float near_m = 0.0F, float far_m = 5.0F);

}  // namespace foothold
