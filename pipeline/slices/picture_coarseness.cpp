#include "pipeline/slices/picture_coarseness.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// A picture becomes finer only if its expected time is below this share of the limit. Otherwise,
// small differences of the speed would change the resolution again and again.
constexpr double kFiner = 0.7;
constexpr double kLeastSeconds = 1e-3;
// The processor's speed is estimated when a picture has been traced for kSpeedSeconds. Rays through
// the centres of all pixels take about 1 / kShownPerLooked of the time until the picture can be
// shown.
constexpr double kSpeedSeconds = 0.1, kShownPerLooked = 1.5, kLeastLooked = 1e-3;

double pixelShare(int coarseness) {
    return std::exp2(-coarseness);
}

}  // namespace

int PictureCoarseness::chosen(double pixels) const {
    if (!(within_ > 0)) return 0;
    const auto isInTime = [&](int coarseness) {
        const double limit = coarseness < last_ ? kFiner * within_ : within_;
        return secondsPerPixel_ * pixelShare(coarseness) * pixels <= limit;
    };
    int coarseness = 0;
    while (coarseness < kCoarsest && !isInTime(coarseness))
        ++coarseness;
    return coarseness;
}

void PictureCoarseness::learn(double pixels, int coarseness, double seconds) {
    if (!(pixels > 0)) return;
    secondsPerPixel_ = std::max(seconds, kLeastSeconds) / (pixels * pixelShare(coarseness));
}

double PictureCoarseness::Begun::expectedSeconds() const {
    return kShownPerLooked * seconds / std::max(looked, kLeastLooked);
}

bool PictureCoarseness::isTooSlow(int coarseness, const Begun& begun) const {
    return within_ > 0 && coarseness < kCoarsest && begun.seconds > kSpeedSeconds &&
           begun.expectedSeconds() > within_;
}

RenderView coarsened(const RenderView& view, int coarseness) {
    if (coarseness == 0) return view;
    const auto scaled = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(std::exp2(-0.5 * coarseness) * side)));
    };
    const Size size = view.camera.size;
    return {view.camera.scaledTo({scaled(size.width), scaled(size.height)}), view.T_world_camera};
}

}  // namespace mfar
