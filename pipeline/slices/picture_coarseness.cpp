#include "pipeline/slices/picture_coarseness.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// A picture becomes finer only if its expected time is below this share of the limit. Otherwise,
// small differences of the speed would change the resolution again and again.
constexpr double kFiner = 0.7;
constexpr double kLeastSeconds = 1e-3;
// Rays through the centres of all pixels take about 1 / kShownPerLooked of the time until the
// picture can be shown.
constexpr double kShownPerLooked = 2;
// Limit of the time until a picture is shown if there is none before it, as a share of the usual
// limit.
constexpr double kUrgent = 0.5;

double pixelShare(int coarseness) {
    return std::exp2(-coarseness);
}

}  // namespace

int PictureCoarseness::chosen(double pixels, std::optional<double> waited) const {
    if (!(within_ > 0)) return 0;
    if (lacksSpeed()) return kCoarsest;
    const double within = waited ? kUrgent * within_ - *waited : within_;
    const auto isInTime = [&](int coarseness) {
        const double limit = coarseness < last_ ? kFiner * within : within;
        return secondsPerPixel_ * pixelShare(coarseness) * pixels <= limit;
    };
    int coarseness = 0;
    while (coarseness < kCoarsest && !isInTime(coarseness))
        ++coarseness;
    return coarseness;
}

void PictureCoarseness::learn(double pixels, int coarseness, double seconds) {
    if (!(pixels > 0)) return;
    const double later = seconds * (1 + budget_.extraMs / budget_.ms);  // without extra time
    secondsPerPixel_ = std::max(later, kLeastSeconds) / (pixels * pixelShare(coarseness));
}

// On a loaded processor, the threads get less time than the budget allows. Then the time that has
// passed counts.
void PictureCoarseness::learnFromLook(double pixels, double ms, double seconds) {
    if (!(pixels > 0)) return;
    const double frames = ms / (budget_.ms + budget_.extraMs);
    const double took =
        std::max(frames * budget_.secondsPerFrame, seconds - budget_.secondsPerFrame);
    secondsPerPixel_ = std::max(kShownPerLooked * took, kLeastSeconds) / pixels;
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
