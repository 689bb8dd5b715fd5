#include "hal/device/display_pixels.h"

#include <cassert>
#include <cstring>

namespace mfar {
namespace {

constexpr std::uint32_t ones(int bits) {
    return bits >= 32 ? ~0U : (1U << bits) - 1;
}

/// Moves the bits of one colour from a pixel with 8 bits per colour to their position in the
/// screen's pixel.
struct Move {
    int from, drop, to;

    Move(int offset, PixelChannel channel)
        : from(offset), drop(8 - channel.length), to(channel.offset) {}
    [[nodiscard]] std::uint32_t operator()(std::uint32_t pixel) const {
        return ((pixel >> from & 0xff) >> drop) << to;
    }
};

/// Writes the lower `Bytes` bytes of a word. Compilers vectorise loops over this function for 2 or
/// 4 bytes.
template <std::size_t Bytes>
void store(std::uint32_t word, std::uint8_t* out) {
    if constexpr (Bytes == 2) {
        const auto half = static_cast<std::uint16_t>(word);
        std::memcpy(out, &half, 2);
    } else {
        std::memcpy(out, &word, Bytes);
    }
}

template <std::size_t Bytes>
void packRow(const std::uint8_t* __restrict pixels, int width, const PixelLayout& layout,
             int redOffset, std::uint8_t* __restrict out) {
    const Move red(redOffset, layout.red), green(8, layout.green),
        blue(16 - redOffset, layout.blue);
    const std::uint32_t opaque =
        layout.alpha.length > 0 ? ones(layout.alpha.length) << layout.alpha.offset : 0;
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
        std::uint32_t pixel = 0;
        std::memcpy(&pixel, pixels + 4 * x, 4);
        store<Bytes>(red(pixel) | green(pixel) | blue(pixel) | opaque, out + Bytes * x);
    }
}

void swapRow(const std::uint8_t* __restrict rgba, int width, std::uint8_t* __restrict out) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
        std::uint32_t pixel = 0;
        std::memcpy(&pixel, rgba + 4 * x, 4);
        pixel = (pixel & 0x0000ff00) | (pixel & 0xff) << 16 | (pixel >> 16 & 0xff) | 0xff000000;
        std::memcpy(out + 4 * x, &pixel, 4);
    }
}

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

void packPixels(const ImageView& picture, const PixelLayout& layout, std::uint8_t* out,
                std::size_t stride) {
    assert(layout.valid());
    assert(picture.format == PixelFormat::Bgra8 || picture.format == PixelFormat::Rgba8);
    const bool blueFirst = picture.format == PixelFormat::Bgra8;
    const int width = picture.size.width, red = blueFirst ? 16 : 0;
    for (int y = 0; y < picture.size.height; ++y) {
        const std::uint8_t* from = picture.data + static_cast<std::size_t>(y) * picture.stride;
        std::uint8_t* to = out + static_cast<std::size_t>(y) * stride;
        if (isBgra(layout) && blueFirst) {
            std::memcpy(to, from, static_cast<std::size_t>(width) * 4);
        } else if (isBgra(layout)) {
            swapRow(from, width, to);
        } else {
            switch (layout.bits) {
            case 16: packRow<2>(from, width, layout, red, to); break;
            case 24: packRow<3>(from, width, layout, red, to); break;
            default: packRow<4>(from, width, layout, red, to);
            }
        }
    }
}

}  // namespace mfar
