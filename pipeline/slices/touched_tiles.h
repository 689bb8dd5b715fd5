#pragma once

#include "pipeline/render/rendered_picture.h"

#include <vector>

namespace mfar {

/// Tiles of 8x8 pixels in which a picture shows an object or changed light.
class TouchedTiles {
public:
    /// Until the next set(), isFarFrom() returns false.
    void clear() { tiles_.clear(); }
    void set(const RenderedPicture& picture);

    /// True if the pixel's tile and all adjacent tiles are known to show no object and no changed
    /// light.
    [[nodiscard]] bool isFarFrom(const Eigen::Vector2d& pixel) const;

private:
    Size size_;  // numbers of tile columns and tile rows
    std::vector<bool> tiles_;
};

}  // namespace mfar
