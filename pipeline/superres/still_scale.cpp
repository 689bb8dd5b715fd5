#include "pipeline/superres/still_scale.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// A reduced still has this number of pixels per output pixel along each axis. With a value of 1,
// the finest detail would be lost, because detail is interpolated between the still's pixels.
// (Measured on photographs: 1.4 gains 0.2 to 0.9 dB over 1, and 1.8 is no better.)
constexpr double kFiner = 1.4;
// A still is reduced only if both its width and its height shrink to less than this fraction. With
// a smaller reduction, the blur by resampling would be worse than the aliasing that it prevents.
constexpr double kWorthReducing = 0.9;

}  // namespace

StereoRig stillFor(Size output, StereoRig rig) {
    const double x = kFiner * output.width * rig.video.fx / (rig.video.size.width * rig.still.fx);
    const double y = kFiner * output.height * rig.video.fy / (rig.video.size.height * rig.still.fy);
    if (std::max(x, y) < kWorthReducing) {
        const auto scaled = [](int pixels, double by) {
            return std::max(1, static_cast<int>(std::lround(pixels * by)));
        };
        rig.still =
            rig.still.scaledTo({scaled(rig.still.size.width, x), scaled(rig.still.size.height, y)});
    }
    return rig;
}

}  // namespace mfar
