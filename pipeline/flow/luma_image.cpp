#include "pipeline/flow/luma_image.h"

#include "base/image_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

// Rec. 601 in 1/65536, which sum to one.
constexpr int kRed = 19595, kGreen = 38470, kBlue = 7471;

void lumaRow(const ImageView& picture, int y, std::uint8_t* to) {
    const std::uint8_t* from = picture.data + static_cast<std::size_t>(y) * picture.stride;
    const int width = picture.size.width;
    if (lumaPlane(picture)) {
        std::copy_n(from, width, to);
        return;
    }
    if (picture.format == PixelFormat::Yuyv) {
        for (int x = 0; x < width; ++x)
            to[x] = from[2 * static_cast<std::size_t>(x)];
        return;
    }
    const bool blueFirst = picture.format == PixelFormat::Bgra8;
    const int first = blueFirst ? kBlue : kRed, third = blueFirst ? kRed : kBlue;
    for (int x = 0; x < width; ++x) {
        const std::uint8_t* p = from + 4 * static_cast<std::size_t>(x);
        to[x] =
            static_cast<std::uint8_t>((first * p[0] + kGreen * p[1] + third * p[2] + 32768) >> 16);
    }
}

/// The pixels that one pixel of a smaller picture covers, the outer two in part; weights sum to
/// one.
struct Span {
    int first, last;
    float firstWeight, innerWeight, lastWeight;

    [[nodiscard]] float weightOf(int i) const {
        if (i == first) return firstWeight;
        return i == last ? lastWeight : innerWeight;
    }
};

std::vector<Span> spansOf(int from, int to) {
    const double step = static_cast<double>(from) / to;
    std::vector<Span> out;
    for (int i = 0; i < to; ++i) {
        const double begin = i * step, end = (i + 1) * step;
        const int first = std::min(static_cast<int>(begin + 1e-6), from - 1);
        const int last = std::clamp(static_cast<int>(std::ceil(end - 1e-6)) - 1, first, from - 1);
        const auto share = [&](double pixels) { return static_cast<float>(pixels / step); };
        out.push_back(
            {first, last, share(std::min(first + 1.0, end) - begin), share(1), share(end - last)});
        if (first == last) out.back().firstWeight = 1;
    }
    return out;
}

}  // namespace

ImageView viewOf(const LumaImage& picture) {
    return {picture.pixels.data(), picture.size, static_cast<std::size_t>(picture.size.width),
            PixelFormat::Gray8};
}

void lumaOf(const ImageView& picture, LumaImage& out) {
    if (!(out.size == picture.size)) out = LumaImage(picture.size);
    for (int y = 0; y < picture.size.height; ++y)
        lumaRow(picture, y, out.row(y));
}

void shrinkLuma(const ImageView& picture, Size size, Workers& workers, LumaImage& out) {
    if (!(out.size == size)) out = LumaImage(size);
    const Size from = picture.size;
    const auto across = spansOf(from.width, size.width), down = spansOf(from.height, size.height);
    workers.forRange(size.height, 4, [&](int first, int last) {
        std::vector<std::uint8_t> luma(from.width);
        std::vector<float> columns(from.width);
        for (int y = first; y < last; ++y) {
            std::fill(columns.begin(), columns.end(), 0.0F);
            for (int j = down[y].first; j <= down[y].last; ++j) {
                lumaRow(picture, j, luma.data());
                const float weight = down[y].weightOf(j);
                for (int x = 0; x < from.width; ++x)
                    columns[x] += weight * static_cast<float>(luma[x]);
            }
            std::uint8_t* to = out.row(y);
            for (int x = 0; x < size.width; ++x) {
                float sum = 0;
                for (int i = across[x].first; i <= across[x].last; ++i)
                    sum += across[x].weightOf(i) * columns[i];
                to[x] = static_cast<std::uint8_t>(std::clamp(sum + 0.5F, 0.0F, 255.0F));
            }
        }
    });
}

void cut(const LumaImage& picture, const PixelRect& pixels, LumaImage& out) {
    out.size = {pixels.x1 - pixels.x0, pixels.y1 - pixels.y0};
    out.pixels.clear();
    for (int y = pixels.y0; y < pixels.y1; ++y)
        out.pixels.insert(out.pixels.end(), picture.row(y) + pixels.x0, picture.row(y) + pixels.x1);
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
