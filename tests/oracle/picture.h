#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

struct TestPicture {
    TestPicture() = default;
    explicit TestPicture(Size s, PixelFormat f = PixelFormat::Rgba8, std::uint8_t fill = 0)
        : size(s), format(f),
          bytes(static_cast<std::size_t>(s.width) * s.height * bytesPerPixel(f), fill) {}
    [[nodiscard]] ImageView view() const {
        return {bytes.data(), size, static_cast<std::size_t>(size.width) * bytesPerPixel(format),
                format};
    }
    [[nodiscard]] std::uint8_t* at(int x, int y) {
        return &bytes[(static_cast<std::size_t>(y) * size.width + x) * bytesPerPixel(format)];
    }

    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    std::vector<std::uint8_t> bytes;
};

}  // namespace mfar
