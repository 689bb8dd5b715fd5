#include "pipeline/slices/touched_tiles.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kEdge = 8;  // [px]

}  // namespace

void TouchedTiles::set(const RenderedPicture& picture) {
    const Size pixels = picture.camera.size;
    size_ = {(pixels.width + kEdge - 1) / kEdge, (pixels.height + kEdge - 1) / kEdge};
    tiles_.assign(static_cast<std::size_t>(size_.width) * size_.height, false);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x)
            if (picture.id[static_cast<std::size_t>(y) * pixels.width + x] != 0)
                tiles_[static_cast<std::size_t>(y / kEdge) * size_.width + x / kEdge] = true;
}

bool TouchedTiles::isFarFrom(const Eigen::Vector2d& pixel) const {
    if (tiles_.empty()) return false;
    const int column = static_cast<int>(std::floor(pixel.x() / kEdge));
    const int row = static_cast<int>(std::floor(pixel.y() / kEdge));
    if (column < 0 || row < 0 || column >= size_.width || row >= size_.height) return false;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, size_.height - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, size_.width - 1); ++x)
            if (tiles_[static_cast<std::size_t>(y) * size_.width + x]) return false;
    return true;
}

}  // namespace mfar
