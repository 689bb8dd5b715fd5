#pragma once

#include "pipeline/render/rendered_picture.h"

#include <vector>

namespace mfar {

/// Tiles of 8x8 pixels in which a picture shows anything.
class TouchedTiles {
public:
    /// Forgets the picture: nothing is known.
    void clear() { tiles_.clear(); }
    void set(const RenderedPicture& picture);

    /// Whether the pixel is known to be farther than a tile from anything shown.
    [[nodiscard]] bool isFarFrom(const Eigen::Vector2d& pixel) const;

private:
    Size size_;  // in tiles
    std::vector<bool> tiles_;
};

}  // namespace mfar
