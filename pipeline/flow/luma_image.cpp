#include "pipeline/flow/luma_image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

// Rec. 601 in 1/65536, which sum to one.
constexpr int kRed = 19595, kGreen = 38470, kBlue = 7471;

}  // namespace

void lumaOf(const ImageView& picture, LumaImage& out) {
    if (!(out.size == picture.size)) out = LumaImage(picture.size);
    for (int y = 0; y < picture.size.height; ++y) {
        const std::uint8_t* from = picture.data + static_cast<std::size_t>(y) * picture.stride;
        std::uint8_t* to = out.row(y);
        if (picture.format == PixelFormat::Gray8) {
            std::copy_n(from, picture.size.width, to);
            continue;
        }
        for (int x = 0; x < picture.size.width; ++x) {
            const std::uint8_t* p = from + 4 * static_cast<std::size_t>(x);
            to[x] = static_cast<std::uint8_t>(
                (kRed * p[0] + kGreen * p[1] + kBlue * p[2] + 32768) >> 16);
        }
    }
}

void halve(const LumaImage& fine, LumaImage& coarse) {
    const Size size{(fine.size.width + 1) / 2, (fine.size.height + 1) / 2};
    if (!(coarse.size == size)) coarse = LumaImage(size);
    const int inner = fine.size.width / 2;
    for (int y = 0; y < size.height; ++y) {
        const std::uint8_t* a = fine.row(2 * y);
        const std::uint8_t* b = fine.row(std::min(2 * y + 1, fine.size.height - 1));
        std::uint8_t* to = coarse.row(y);
        for (int x = 0; x < inner; ++x)
            to[x] = static_cast<std::uint8_t>(
                (a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) >> 2);
        if (inner < size.width)
            to[inner] = static_cast<std::uint8_t>((a[2 * inner] + b[2 * inner] + 1) >> 1);
    }
}

void smooth(const LumaImage& in, float side, LumaImage& out) {
    if (!(out.size == in.size)) out = LumaImage(in.size);
    const int w = in.size.width, h = in.size.height;
    const int s = static_cast<int>(std::lround(256 * std::clamp(side, 0.0F, 0.333F)));
    const int c = 256 - 2 * s;
    std::vector<int> column(static_cast<std::size_t>(w) + 2);
    for (int y = 0; y < h; ++y) {
        const std::uint8_t* above = in.row(std::max(y - 1, 0));
        const std::uint8_t* here = in.row(y);
        const std::uint8_t* below = in.row(std::min(y + 1, h - 1));
        for (int x = 0; x < w; ++x)
            column[x + 1] = s * (above[x] + below[x]) + c * here[x];
        column.front() = column[1];
        column.back() = column[w];
        std::uint8_t* to = out.row(y);
        for (int x = 0; x < w; ++x)
            to[x] = static_cast<std::uint8_t>(
                (s * (column[x] + column[x + 2]) + c * column[x + 1] + 32768) >> 16);
    }
}

double noiseOf(const LumaImage& picture) {
    constexpr int kBlock = 8;
    std::vector<int> sums;
    for (int by = 1; by + kBlock < picture.size.height; by += kBlock) {
        for (int bx = 1; bx + kBlock < picture.size.width; bx += kBlock) {
            int sum = 0;
            for (int y = by; y < by + kBlock; ++y) {
                const std::uint8_t *a = picture.row(y - 1), *b = picture.row(y),
                                   *c = picture.row(y + 1);
                for (int x = bx; x < bx + kBlock; ++x)
                    sum += std::abs(a[x - 1] + a[x + 1] + c[x - 1] + c[x + 1] -
                                    2 * (a[x] + b[x - 1] + b[x + 1] + c[x]) + 4 * b[x]);
            }
            sums.push_back(sum);
        }
    }
    if (sums.empty()) return 0;
    const auto quiet = sums.begin() + static_cast<std::ptrdiff_t>(sums.size() / 5);
    std::nth_element(sums.begin(), quiet, sums.end());
    // The mask multiplies white noise by 6; sqrt(pi / 2) makes a standard deviation of its mean.
    return std::sqrt(1.5708) * *quiet / (6.0 * kBlock * kBlock);
}

}  // namespace mfar
