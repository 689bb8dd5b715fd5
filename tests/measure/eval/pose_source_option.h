#pragma once

#include "tests/measure/eval/pose_source.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// Adds the option --poses, which sets `source`.
void addPoseSource(CLI::App& sub, PoseSource& source);

}  // namespace mfar::eval
