// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/recording_options.h"

namespace foothold::apps {

void add_recording_options(CommandLine& app, SequenceOptions& options) {
  app.add_option("--intrinsics", options.intrinsics,
                 "The depth camera of recordings, instead of what their files say: fx,fy,cx,cy, with distortion k1,k2,p1,p2,k3 behind if "
                 "wanted, or a file")
      .type_name("FX,FY,CX,CY|FILE");
  app.add_option("--depth-scale", options.depth_units_per_m,
                 "What their depth images count, such as 1000 for millimetres or 5000 for the TUM benchmark's")
      .type_name("UNITS_PER_M");
  app.add_option("--pose-convention", options.pose_convention,
                 "How their poses are to be understood: words of inverse, opengl, ros, mirror-y, w-first, mm, cm, separated by commas, or "
                 "as-is (docs/sequences.md)")
      .type_name("WORDS");
}

}  // namespace foothold::apps
