#pragma once

#include "pipeline/render/rendered_picture.h"

#include <vector>

namespace mfar {

/// Where a picture shows anything, by tiles of 8x8 pixels.
class TouchedTiles {
public:
    /// Nothing is known.
    void clear() { tiles_.clear(); }
    void set(const RenderedPicture& picture);

    /// Whether it is known that the pixel is farther than a tile from anything that is shown.
    [[nodiscard]] bool isFarFrom(const Eigen::Vector2d& pixel) const;

private:
    Size size_;  // in tiles
    std::vector<bool> tiles_;
};

}  // namespace mfar
