#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <cmath>

namespace mfar {

PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture) {
    const auto held = [margin](double v, int side) {
        return static_cast<int>(std::clamp(v, -1.0 - margin, side + 1.0 + margin));
    };
    return common({held(std::floor(box.min().x()), picture.width) - margin,
                   held(std::floor(box.min().y()), picture.height) - margin,
                   held(std::ceil(box.max().x()), picture.width) + 1 + margin,
                   held(std::ceil(box.max().y()), picture.height) + 1 + margin},
                  {0, 0, picture.width, picture.height});
}

}  // namespace mfar
