#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "base/rows.h"
#include "base/workers.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// A grey picture in main memory, 8 bits per pixel, rows without gaps.
struct LumaImage {
    Size size;
    std::vector<std::uint8_t> pixels;

    LumaImage() = default;
    explicit LumaImage(Size s) : size(s), pixels(static_cast<std::size_t>(s.width) * s.height) {}
    /// Reuses the memory if it is large enough; pixel values are then undefined.
    void setSize(Size s) {
        size = s;
        pixels.resize(static_cast<std::size_t>(s.width) * s.height);
    }
    [[nodiscard]] const std::uint8_t* row(int y) const {
        return pixels.data() + static_cast<std::size_t>(y) * size.width;
    }
    [[nodiscard]] std::uint8_t* row(int y) {
        return pixels.data() + static_cast<std::size_t>(y) * size.width;
    }
    [[nodiscard]] Rows<const std::uint8_t> rows() const {
        return {pixels.data(), size.width, size};
    }
    // NOLINTNEXTLINE(google-explicit-constructor): what reads a picture need not own it
    operator Rows<const std::uint8_t>() const { return rows(); }
};

[[nodiscard]] ImageView viewOf(const LumaImage& picture);

/// Luma of a picture: for RGBA and BGRA as luma.glsl computes it (Rec. 601), otherwise the camera's
/// own Y, whatever its matrix and range. The costs of flow and pose are invariant to gain and
/// offset, so limited range (219/255 of full range's contrast) need not be stretched. `out` gets
/// its size.
void lumaOf(const ImageView& picture, LumaImage& out);

/// The picture's luma at a smaller or equal size: each pixel is the mean of the area that it
/// covers.
void shrinkLuma(const ImageView& picture, Size size, Workers& workers, LumaImage& out);

/// As above, from a picture's luma.
void shrinkLuma(const Rows<const std::uint8_t>& luma, Size size, Workers& workers, LumaImage& out);

/// Copies these pixels of a picture, which must contain them all.
void cut(const Rows<const std::uint8_t>& picture, const PixelRect& pixels, LumaImage& out);

/// Half the size, rounded up: mean of 2x2 pixels; the last column and row are replicated.
void halve(const LumaImage& fine, LumaImage& coarse);

/// Three-tap filter along both axes; `side`: weight of a neighbour in [0, 1/3]; `in` and `out`
/// differ.
void smooth(const LumaImage& in, float side, LumaImage& out);

/// Standard deviation of the picture's noise [grey levels], from the quietest fifth of its 8x8
/// blocks, filtered by a mask that suppresses planes, and steps and lines along the axes.
/// Source: Immerkaer, Fast noise variance estimation, 1996 (the mask).
[[nodiscard]] double noiseOf(const Rows<const std::uint8_t>& picture);

}  // namespace mfar
