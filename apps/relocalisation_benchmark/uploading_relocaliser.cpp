// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "uploading_relocaliser.h"

#include <utility>

namespace foothold::benchmark {

UploadingRelocaliser::UploadingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser)
    : RelocaliserDecorator(std::move(relocaliser)), uploader_(context) {}

void UploadingRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  inner().train(uploader_.upload(frame), world_from_camera);
}

std::vector<PoseEstimate> UploadingRelocaliser::relocalise(const Frame& frame) { return inner().relocalise(uploader_.upload(frame)); }

}  // namespace foothold::benchmark
