// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "undistortion.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "foothold/base/contract.h"

namespace foothold::io {

struct Undistortion::Maps {
  cv::Mat pixel;     ///< whole source pixels, CV_16SC2
  cv::Mat fraction;  ///< what interpolation adds to them
};

Undistortion::Undistortion(const CameraModel& camera) {
  if (!camera.distortion.any()) return;
  const Intrinsics& k = camera.intrinsics;
  const auto& c = camera.distortion.coefficients;
  const cv::Matx33d matrix(k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0);
  const cv::Size size(camera.size.width, camera.size.height);
  maps_ = std::make_unique<Maps>();
  if (camera.distortion.model == Distortion::Model::kKannalaBrandt) {
    const cv::Vec4d coefficients(c[0], c[1], c[2], c[3]);
    cv::fisheye::initUndistortRectifyMap(matrix, coefficients, cv::Matx33d::eye(), matrix, size, CV_16SC2, maps_->pixel, maps_->fraction);
  } else {
    const cv::Mat coefficients(1, static_cast<int>(c.size()), CV_64FC1, const_cast<double*>(c.data()));
    cv::initUndistortRectifyMap(matrix, coefficients, cv::noArray(), matrix, size, CV_16SC2, maps_->pixel, maps_->fraction);
  }
}

Undistortion::~Undistortion() = default;
Undistortion::Undistortion(Undistortion&&) noexcept = default;
Undistortion& Undistortion::operator=(Undistortion&&) noexcept = default;

template <class T>
void Undistortion::resample(Image<T>& image, int type, int interpolation) const {
  if (maps_ == nullptr) return;
  FOOTHOLD_EXPECTS(image.width() == maps_->pixel.cols && image.height() == maps_->pixel.rows);
  Image<T> result(image.width(), image.height());
  const cv::Mat source(image.height(), image.width(), type, image.data());
  cv::Mat target(image.height(), image.width(), type, result.data());
  cv::remap(source, target, maps_->pixel, maps_->fraction, interpolation, cv::BORDER_CONSTANT);
  image = std::move(result);
}

void Undistortion::apply(Image<Rgb8>& image) const { resample(image, CV_8UC3, cv::INTER_LINEAR); }
void Undistortion::apply(Image<std::uint16_t>& image) const { resample(image, CV_16UC1, cv::INTER_NEAREST); }
void Undistortion::apply(Image<float>& image) const { resample(image, CV_32FC1, cv::INTER_NEAREST); }

}  // namespace foothold::io
