#include "hal/device/display_pixels.h"

#include <cassert>
#include <cstring>

namespace mfar {
namespace {

constexpr std::uint32_t ones(int bits) {
    return bits >= 32 ? ~0U : (1U << bits) - 1;
}

constexpr std::uint32_t put(std::uint8_t value, PixelChannel channel) {
    return static_cast<std::uint32_t>(value >> (8 - channel.length)) << channel.offset;
}

template <std::size_t Bytes>
void packRow(const std::uint8_t* bgra, int width, const PixelLayout& layout, std::uint8_t* out) {
    const PixelLayout l = layout;  // a copy that no byte written below can alias
    const std::uint32_t opaque = l.alpha.length > 0 ? ones(l.alpha.length) << l.alpha.offset : 0;
    for (int x = 0; x < width; ++x, bgra += 4, out += Bytes) {
        const std::uint32_t word =
            put(bgra[2], l.red) | put(bgra[1], l.green) | put(bgra[0], l.blue) | opaque;
        for (std::size_t i = 0; i < Bytes; ++i)
            out[i] = static_cast<std::uint8_t>(word >> (8 * i));
    }
}

// As the GPU has written it.
bool isBgra(const PixelLayout& layout) {
    return layout.bits == 32 && layout.red == PixelChannel{16, 8} &&
           layout.green == PixelChannel{8, 8} && layout.blue == PixelChannel{0, 8};
}

}  // namespace

bool PixelLayout::valid() const {
    if (bits != 16 && bits != 24 && bits != 32) return false;
    const auto fits = [this](const PixelChannel& c, int shortest) {
        return c.offset >= 0 && c.length >= shortest && c.length <= 8 &&
               c.offset <= bits - c.length;
    };
    return fits(red, 1) && fits(green, 1) && fits(blue, 1) && (alpha.length == 0 || fits(alpha, 1));
}

void packPixels(const ImageView& bgra, const PixelLayout& layout, std::uint8_t* out,
                std::size_t stride) {
    assert(layout.valid() && bgra.format == PixelFormat::Bgra8);
    const auto width = static_cast<std::size_t>(bgra.size.width);
    for (int y = 0; y < bgra.size.height; ++y) {
        const std::uint8_t* from = bgra.data + static_cast<std::size_t>(y) * bgra.stride;
        std::uint8_t* to = out + static_cast<std::size_t>(y) * stride;
        if (isBgra(layout)) {
            std::memcpy(to, from, width * 4);
        } else {
            switch (layout.bits) {
            case 16: packRow<2>(from, bgra.size.width, layout, to); break;
            case 24: packRow<3>(from, bgra.size.width, layout, to); break;
            default: packRow<4>(from, bgra.size.width, layout, to);
            }
        }
    }
}

}  // namespace mfar
