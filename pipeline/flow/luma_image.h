#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "base/rows.h"
#include "base/workers.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// A grey picture in CPU memory with 8 bits per pixel and no gaps between rows.
struct LumaImage {
    Size size;
    std::vector<std::uint8_t> pixels;

    LumaImage() = default;
    explicit LumaImage(Size s) : size(s), pixels(static_cast<std::size_t>(s.width) * s.height) {}
    /// Sets the size. Pixel values are undefined afterwards. The memory is kept if it is large
    /// enough.
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
    // NOLINTNEXTLINE(google-explicit-constructor): implicit, because readers take Rows
    operator Rows<const std::uint8_t>() const { return rows(); }
};

[[nodiscard]] ImageView viewOf(const LumaImage& picture);

/// Converts a picture to luma and sets the size of `out`. For RGBA and BGRA, luma is computed as in
/// luma.glsl (Rec. 601). For other formats, it is the camera's Y, with any matrix and range; this
/// is possible because matching for flow and pose does not depend on gain and offset.
void lumaOf(const ImageView& picture, LumaImage& out);

/// Computes the luma of the picture at the smaller or equal size `size`. Each pixel of `out` is the
/// mean of the area that it covers in the picture.
void shrinkLuma(const ImageView& picture, Size size, Workers& workers, LumaImage& out);

void shrinkLuma(const Rows<const std::uint8_t>& luma, Size size, Workers& workers, LumaImage& out);

/// Copies the rectangle `pixels` of `picture` to `out`. The rectangle must be completely inside the
/// picture.
void cut(const Rows<const std::uint8_t>& picture, const PixelRect& pixels, LumaImage& out);

/// Halves the size of a picture: each pixel of `coarse` is the mean of 2x2 pixels. An odd width or
/// height is rounded up, and its last column or row is repeated.
void halve(const LumaImage& fine, LumaImage& coarse);

/// Smooths a picture with a three-tap filter along both axes. `side` is the weight of each of the
/// two neighbours, in [0, 1/3]. `in` and `out` must be different pictures.
void smooth(const LumaImage& in, float side, LumaImage& out);

/// Measures the noise of a picture, or of parts of it. A filter (Immerkaer, Fast noise variance
/// estimation, 1996) first removes smooth slopes, and steps and lines along the axes. Then the
/// noise of each block of 8x8 pixels is measured.
class BlockNoise {
public:
    /// Adds the blocks of a picture. The outermost pixels only serve the filter.
    void add(const Rows<const std::uint8_t>& picture);
    /// Returns the 20 % quantile of the blocks' standard deviations [grey levels], and forgets the
    /// blocks. Without blocks, the result is 0.
    [[nodiscard]] double take();

private:
    std::vector<int> sums_;
};

/// Returns the standard deviation of the picture's noise [grey levels], see BlockNoise.
[[nodiscard]] double noiseOf(const Rows<const std::uint8_t>& picture);

}  // namespace mfar
