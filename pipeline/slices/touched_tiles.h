#pragma once

#include "pipeline/render/rendered_picture.h"

#include <vector>

namespace mfar {

/// The tiles of 8x8 pixels in which a picture shows an object or changed light.
class TouchedTiles {
public:
    /// Discards the picture. isFarFrom() is false until the next set().
    void clear() { tiles_.clear(); }
    void set(const RenderedPicture& picture);

    /// Whether neither the pixel's tile nor an adjacent tile shows an object or changed light.
    /// False if this is unknown.
    [[nodiscard]] bool isFarFrom(const Eigen::Vector2d& pixel) const;

private:
    Size size_;  // size in tiles
    std::vector<bool> tiles_;
};

}  // namespace mfar
