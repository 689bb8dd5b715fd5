#pragma once

#include "base/image_layout.h"

#include <cstdint>
#include <random>
#include <vector>

namespace mfar::test {

inline constexpr PixelFormat kEveryFormat[]{PixelFormat::Gray8, PixelFormat::Rgba8,
                                            PixelFormat::Bgra8, PixelFormat::Yuyv,
                                            PixelFormat::Nv12,  PixelFormat::Yuv420};

/// A picture of random bytes with a driver's memory layout: every plane has its own memory and
/// padded rows. The padding differs between planes.
class PaddedPicture {
public:
    PaddedPicture(PixelFormat format, Size size, unsigned seed, std::size_t padding = 8) {
        view_.size = size;
        view_.format = format;
        std::mt19937 random(seed);
        for (int i = 0; i < planeCount(format); ++i) {
            const PlaneSize plane = planeSize(format, size, i);
            const std::size_t stride = plane.rowBytes + padding + 4 * static_cast<std::size_t>(i);
            planes_[i].resize(stride * plane.rows);
            for (auto& b : planes_[i])
                b = static_cast<std::uint8_t>(random() >> 24);
            if (i == 0) {
                view_.data = planes_[0].data();
                view_.stride = stride;
            } else {
                view_.chroma[static_cast<std::size_t>(i) - 1] = {planes_[i].data(), stride};
            }
        }
    }
    PaddedPicture(const PaddedPicture&) = delete;
    PaddedPicture& operator=(const PaddedPicture&) = delete;
    ~PaddedPicture() = default;

    [[nodiscard]] ImageView view(YuvMatrix matrix = YuvMatrix::Bt601,
                                 YuvRange range = YuvRange::Limited) const {
        ImageView out = view_;
        out.matrix = matrix;
        out.range = range;
        return out;
    }
    [[nodiscard]] std::vector<std::uint8_t>& plane(int i) { return planes_[i]; }

private:
    ImageView view_;
    std::vector<std::uint8_t> planes_[3];
};

}  // namespace mfar::test
