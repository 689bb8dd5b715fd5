#include "pipeline/gles/still_reducer.h"

#include <string>

namespace mfar {
namespace {

float ratio(int from, int to) {
    return static_cast<float>(from) / static_cast<float>(to);
}

std::string tapsFor(float scale) {
    return "#define TAPS " + std::to_string(static_cast<int>(2 * scale) + 1) + "\n";
}

}  // namespace

StillReducer::StillReducer(Size from, Size to)
    : scale_{ratio(from.width, to.width), ratio(from.height, to.height)},
      narrow_({to.width, from.height}, gpu::TexelFormat::Rgba8),
      reduced_(to, gpu::TexelFormat::Rgba8, gpu::Filter::Linear), narrowTarget_(narrow_),
      reducedTarget_(reduced_), across_("still_reduce.frag", tapsFor(scale_[0])),
      down_("still_reduce.frag", tapsFor(scale_[1])) {}

void StillReducer::run(const gpu::Texture& picture) {
    across_.run({.alongX = 1, .alongY = 0, .scale = scale_[0]}, {gpu::sampler(0, picture)},
                narrowTarget_);
    down_.run({.alongX = 0, .alongY = 1, .scale = scale_[1]}, {gpu::sampler(0, narrow_)},
              reducedTarget_);
}

}  // namespace mfar
