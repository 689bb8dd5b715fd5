#include "daemon/picture_size.h"
#include "pipeline/pipeline.h"

#include <algorithm>
#include <cmath>

namespace mfar {

Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                   const std::optional<Size>& screen) {
    const Size full = Pipeline::fullSize(rig);
    std::optional<Size> within = wanted.given;
    if (wanted.fits == PictureSize::Fits::Screen) within = screen;
    if (wanted.fits == PictureSize::Fits::Still || !within || within->width < 1) return full;
    const double fitting = std::min(static_cast<double>(within->width) / full.width,
                                    static_cast<double>(within->height) / full.height);
    const double least = static_cast<double>(rig.video.size.width) / full.width;
    const double scale = std::min(1.0, std::max(fitting, least));
    const auto side = [scale](int length) {
        return std::max(1, static_cast<int>(std::lround(length * scale)));
    };
    return {side(full.width), side(full.height)};
}

}  // namespace mfar
