#include "pipeline/slices/rest_watch.h"

#include <algorithm>

namespace mfar {
namespace {

// The camera rests if it moves by less than kPixels in kLooks calls of look().
constexpr double kPixels = 0.1;
constexpr int kLooks = 10;

}  // namespace

bool RestWatch::rests() const {
    return looks_ == kLooks;
}

void RestWatch::look(const RenderView& now, std::span<const ObjectBall> objects) {
    if (pixelChange(at_, now, objects) < kPixels) {
        looks_ = std::min(looks_ + 1, kLooks);
    } else {
        at_ = now;
        looks_ = 0;
    }
}

}  // namespace mfar
