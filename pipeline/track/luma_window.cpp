#include "pipeline/track/luma_window.h"

#include <algorithm>

namespace mfar {

ImageView LumaWindow::of(const ImageView& picture, const PixelRect& part) {
    if (picture.format == PixelFormat::Gray8) return picture;
    const auto [width, height] = picture.size;
    buffer_.resize(static_cast<std::size_t>(width) * height);
    const int x0 = std::clamp(part.x0, 0, width), x1 = std::clamp(part.x1, x0, width);
    const int y0 = std::clamp(part.y0, 0, height), y1 = std::clamp(part.y1, y0, height);
    for (int y = y0; y < y1; ++y) {
        const std::uint8_t* in = picture.data + y * picture.stride + 4L * x0;
        std::uint8_t* out = buffer_.data() + static_cast<std::size_t>(y) * width + x0;
        for (int i = 0; i < x1 - x0; ++i, in += 4)
            out[i] = static_cast<std::uint8_t>((77 * in[0] + 150 * in[1] + 29 * in[2] + 128) >> 8);
    }
    return {buffer_.data(), picture.size, static_cast<std::size_t>(width), PixelFormat::Gray8};
}

}  // namespace mfar
