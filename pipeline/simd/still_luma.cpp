#include "pipeline/simd/still_luma.h"

#include "base/image_layout.h"
#include "pipeline/engine/params/luma.h"
#include "pipeline/simd/luma_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mfar::simd {
namespace {

constexpr std::array<float, 3> kRec601{params::kLumaRed, params::kLumaGreen, params::kLumaBlue};
// Chroma is ignored if its coefficients are below this threshold: it then changes luma by less than
// 0.3 grey levels.
constexpr float kLeastChroma = 1e-3F;

bool isYuv(PixelFormat format) {
    return format == PixelFormat::Yuyv || format == PixelFormat::Nv12 ||
           format == PixelFormat::Yuv420;
}

}  // namespace

StillLuma::StillLuma(const ImageView& picture) : picture_(picture) {
    if (!isYuv(picture.format)) return;
    const YuvToRgb rows = yuvToRgb(picture.matrix, picture.range);
    std::array<float, 4> by{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            by[j] += kRec601[i] * rows[i][j];
    // The offset is luma at Y = 0 and chroma of 128, because chromaRow() subtracts 128 from chroma.
    gain_ = {static_cast<std::int16_t>(std::lround(by[0] * 16384)),
             static_cast<std::int16_t>(std::lround(32 * (by[3] + 128 * (by[1] + by[2]))))};
    needsChroma_ = std::max(std::abs(by[1]), std::abs(by[2])) > kLeastChroma;
    const auto& [u, v] = picture.chroma;
    switch (picture.format) {
    case PixelFormat::Yuyv:
        step_ = 4;
        chroma_ = {Samples{picture.data + 1, picture.stride, by[1]},
                   {picture.data + 3, picture.stride, by[2]}};
        break;
    case PixelFormat::Nv12:
        step_ = 2;
        chroma_ = {Samples{u.data, u.stride, by[1]}, {u.data + 1, u.stride, by[2]}};
        break;
    default: chroma_ = {Samples{u.data, u.stride, by[1]}, {v.data, v.stride, by[2]}};
    }
}

void StillLuma::row(int y, Scratch& scratch, std::uint8_t* luma) const {
    const auto pixels = static_cast<std::size_t>(picture_.size.width);
    const std::uint8_t* from = picture_.data + y * picture_.stride;
    switch (picture_.format) {
    case PixelFormat::Gray8: std::memcpy(luma, from, pixels); return;
    case PixelFormat::Rgba8: lumaRow(from, false, pixels, luma); return;
    case PixelFormat::Bgra8: lumaRow(from, true, pixels, luma); return;
    case PixelFormat::Yuyv: lumaOfPairs(from, chromaRow(y, scratch), gain_, pixels, luma); return;
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: lumaOfPlane(from, chromaRow(y, scratch), gain_, pixels, luma);
    }
}

// Interpolates chroma for row y. Along each axis in which chroma has fewer samples than Y, the
// result is 3/4 of the nearest sample plus 1/4 of the second nearest. Returns null if luma does not
// depend on chroma.
const std::int16_t* StillLuma::chromaRow(int y, Scratch& scratch) const {
    if (!needsChroma_) return nullptr;
    const int width = picture_.size.width / 2;
    const bool sharedRows = picture_.format != PixelFormat::Yuyv;
    const int row = sharedRows ? y / 2 : y;
    const int beside = y % 2 == 0 ? row - 1 : row + 1;
    const int other = sharedRows ? std::clamp(beside, 0, picture_.size.height / 2 - 1) : row;
    float* half = scratch.half[0] + 1;
    std::fill_n(half, width, 0.0F);
    for (const Samples& plane : chroma_) {
        const std::uint8_t *near = plane.data + row * plane.stride,
                           *far = plane.data + other * plane.stride;
        for (int x = 0; x < width; ++x)
            half[x] += plane.gain * static_cast<float>(3 * near[step_ * x] + far[step_ * x] - 512);
    }
    half[-1] = half[0];
    half[width] = half[width - 1];
    std::int16_t* to = scratch.chroma[0];
    constexpr float kScale = 32.0F / 16;
    for (int x = 0; x < width; ++x) {
        to[2 * x] = static_cast<std::int16_t>(kScale * (3 * half[x] + half[x - 1]));
        to[2 * x + 1] = static_cast<std::int16_t>(kScale * (3 * half[x] + half[x + 1]));
    }
    return to;
}

}  // namespace mfar::simd
