#pragma once

#include "tests/measure/eval/pose_source.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

void addPoseSource(CLI::App& sub, PoseSource& source);

}  // namespace mfar::eval
