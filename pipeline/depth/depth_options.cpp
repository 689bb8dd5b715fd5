#include "pipeline/depth/depth_options.h"

#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void require(bool holds, const char* option, const char* range) {
    if (!holds) throw std::invalid_argument(std::string(option) + " must be in " + range);
}

}  // namespace

void validate(const KeyframeOptions& o) {
    require(o.frames >= 2 && o.frames <= 64, "frames", "[2, 64]");
    require(o.distance >= 1 && o.distance < o.frames, "distance", "[1, frames)");
    require(o.angle > 0 && o.angle <= 1, "angle", "(0, 1]");
    require(o.leastAngle > 0 && o.leastAngle <= 1, "leastAngle", "(0, 1]");
    require(o.leastOverlap >= 0 && o.leastOverlap <= 1, "leastOverlap", "[0, 1]");
}

void validate(const DepthOptions& o) {
    validate(o.keyframes);
    validate(o.search);
    require(o.enough >= 0.001 && o.enough <= 1, "enough", "[0.001, 1]");
}

}  // namespace mfar
