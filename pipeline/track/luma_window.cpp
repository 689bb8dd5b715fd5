#include "pipeline/track/luma_window.h"

#include "base/image_layout.h"

#include <algorithm>

namespace mfar {
namespace {

void lumaOf(PixelFormat packed, const std::uint8_t* in, int count, std::uint8_t* out) {
    if (packed == PixelFormat::Yuyv) {
        for (int i = 0; i < count; ++i, in += 2)
            out[i] = in[0];
        return;
    }
    const int red = packed == PixelFormat::Bgra8 ? 2 : 0, blue = 2 - red;
    for (int i = 0; i < count; ++i, in += 4)
        out[i] = static_cast<std::uint8_t>((77 * in[red] + 150 * in[1] + 29 * in[blue] + 128) >> 8);
}

}  // namespace

ImageView LumaWindow::of(const ImageView& picture, const PixelRect& part) {
    if (const auto plane = lumaPlane(picture)) return *plane;
    const auto [width, height] = picture.size;
    buffer_.resize(static_cast<std::size_t>(width) * height);
    const int x0 = std::clamp(part.x0, 0, width), x1 = std::clamp(part.x1, x0, width);
    const int y0 = std::clamp(part.y0, 0, height), y1 = std::clamp(part.y1, y0, height);
    for (int y = y0; y < y1; ++y) {
        const std::uint8_t* in =
            picture.data + y * picture.stride + 1L * bytesPerPixel(picture.format) * x0;
        lumaOf(picture.format, in, x1 - x0,
               buffer_.data() + static_cast<std::size_t>(y) * width + x0);
    }
    return {buffer_.data(), picture.size, static_cast<std::size_t>(width), PixelFormat::Gray8};
}

}  // namespace mfar
