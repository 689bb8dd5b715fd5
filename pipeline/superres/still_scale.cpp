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

// Less noise than this [grey levels] is invisible and is not removed.
constexpr double kSeenNoise = 0.75;
// No sensor has more noise than this [grey levels]. If more is measured in a still, the still has
// very fine texture.
constexpr double kMostNoise = 12;
// The removed variance is this factor times the noise variance. In flat areas, the variance of 3x3
// pixels varies by a half, so a factor of 1 would leave specks. Measured on photographs with added
// noise of 3 and 6 grey levels in the stills: compared with stills whose noise is not removed, the
// factor 4 gains 0.5 and 1.9 dB. Factors from 3 to 6 differ by 0.03 dB.
constexpr double kRemoved = 4;

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

float quietVariance(double noise, Size whole, Size shown) {
    if (!(noise >= kSeenNoise)) return 0;
    // The tent filter of the reduction keeps this share of the variance of white noise.
    const auto kept = [](int from, int to) { return from == to ? 1.0 : 2.0 * to / (3.0 * from); };
    const double level = std::min(noise, kMostNoise);
    return static_cast<float>(kRemoved * level * level * kept(whole.width, shown.width) *
                              kept(whole.height, shown.height));
}

}  // namespace mfar
