#include "pipeline/flow/luma_image.h"

#include "base/image_layout.h"
#include "pipeline/simd/luma_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mfar {
namespace {

constexpr int kNoiseBlock = 8;  // side of a block of BlockNoise [px]

// Weights of red, green and blue in the luma (Rec. 601), multiplied by 65536.
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

/// The pixels that one pixel of a smaller picture covers along one axis, and their weights. The
/// first and the last of these pixels may be covered only partly. The weights of all pixels add up
/// to one.
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

namespace {

/// `rowOf(y, scratch)` returns row y of the luma. The row is either in the picture's memory, or
/// rowOf() writes it to `scratch`.
template <class RowOf>
void shrinkRows(Size from, Size size, const RowOf& rowOf, Workers& workers, LumaImage& out) {
    if (!(out.size == size)) out = LumaImage(size);
    const auto across = spansOf(from.width, size.width), down = spansOf(from.height, size.height);
    workers.forRange(size.height, 4, [&](int first, int last) {
        std::vector<std::uint8_t> luma(from.width);
        std::vector<float> columns(from.width);
        for (int y = first; y < last; ++y) {
            std::fill(columns.begin(), columns.end(), 0.0F);
            for (int j = down[y].first; j <= down[y].last; ++j)
                simd::addWeighted(rowOf(j, luma.data()), down[y].weightOf(j), columns.size(),
                                  columns.data());
            std::uint8_t* to = out.row(y);
            for (int x = 0; x < size.width; ++x) {
                const Span& span = across[x];
                float sum = 0;
                for (int i = span.first + 1; i < span.last; ++i)
                    sum += columns[i];
                sum *= span.innerWeight;
                sum += span.firstWeight * columns[span.first];
                if (span.last > span.first) sum += span.lastWeight * columns[span.last];
                to[x] = static_cast<std::uint8_t>(std::clamp(sum + 0.5F, 0.0F, 255.0F));
            }
        }
    });
}

}  // namespace

void shrinkLuma(const ImageView& picture, Size size, Workers& workers, LumaImage& out) {
    if (const auto luma = lumaPlane(picture)) {
        shrinkLuma(Rows<const std::uint8_t>{luma->data, static_cast<std::ptrdiff_t>(luma->stride),
                                            luma->size},
                   size, workers, out);
        return;
    }
    const auto rowOf = [&](int y, std::uint8_t* scratch) {
        lumaRow(picture, y, scratch);
        return scratch;
    };
    shrinkRows(picture.size, size, rowOf, workers, out);
}

void shrinkLuma(const Rows<const std::uint8_t>& luma, Size size, Workers& workers, LumaImage& out) {
    if (luma.size == size) {
        cut(luma, {0, 0, size.width, size.height}, out);
        return;
    }
    shrinkRows(luma.size, size, [&](int y, std::uint8_t*) { return luma[y]; }, workers, out);
}

void cut(const Rows<const std::uint8_t>& picture, const PixelRect& pixels, LumaImage& out) {
    out.setSize({pixels.x1 - pixels.x0, pixels.y1 - pixels.y0});
    for (int y = pixels.y0; y < pixels.y1; ++y)
        std::copy_n(picture[y] + pixels.x0, out.size.width, out.row(y - pixels.y0));
}

void halve(const LumaImage& fine, LumaImage& coarse) {
    const Size size{(fine.size.width + 1) / 2, (fine.size.height + 1) / 2};
    if (!(coarse.size == size)) coarse.setSize(size);
    const int inner = fine.size.width / 2;
    for (int y = 0; y < size.height; ++y) {
        const std::uint8_t* a = fine.row(2 * y);
        const std::uint8_t* b = fine.row(std::min(2 * y + 1, fine.size.height - 1));
        std::uint8_t* to = coarse.row(y);
        simd::halveRow(a, b, inner, to);
        if (inner < size.width)
            to[inner] = static_cast<std::uint8_t>((a[2 * inner] + b[2 * inner] + 1) >> 1);
    }
}

void smooth(const LumaImage& in, float side, LumaImage& out) {
    if (!(out.size == in.size)) out.setSize(in.size);
    const int height = in.size.height;
    const int s = static_cast<int>(std::lround(256 * std::clamp(side, 0.0F, 0.333F)));
    for (int y = 0; y < height; ++y)
        simd::smoothRow(in.row(std::max(y - 1, 0)), in.row(y), in.row(std::min(y + 1, height - 1)),
                        in.size.width, s, out.row(y));
}

void BlockNoise::add(const Rows<const std::uint8_t>& picture) {
    constexpr int kRun = 32;
    const int blocks = (picture.size.width - 2) / kNoiseBlock;
    for (int y = 1; y + kNoiseBlock < picture.size.height; y += kNoiseBlock) {
        for (int first = 0; first < blocks; first += kRun) {
            const int count = std::min(kRun, blocks - first);
            std::array<std::uint16_t, kRun * kNoiseBlock> columns;
            const Rows<const std::uint8_t> part{picture.data + first * kNoiseBlock, picture.pitch,
                                                picture.size};
            simd::noiseColumns(part, y, kNoiseBlock, count * kNoiseBlock, columns.data());
            for (int b = 0; b < count; ++b)
                sums_.push_back(std::accumulate(columns.begin() + b * kNoiseBlock,
                                                columns.begin() + (b + 1) * kNoiseBlock, 0));
        }
    }
}

double BlockNoise::take() {
    if (sums_.empty()) return 0;
    const auto quiet = sums_.begin() + static_cast<std::ptrdiff_t>(sums_.size() / 5);
    std::nth_element(sums_.begin(), quiet, sums_.end());
    const int sum = *quiet;
    sums_.clear();
    // For white noise, the result of the filter in noiseColumns() has 6 times the standard
    // deviation of the noise. The factor sqrt(pi / 2) converts a mean absolute value to a standard
    // deviation.
    return std::sqrt(1.5708) * sum / (6.0 * kNoiseBlock * kNoiseBlock);
}

double noiseOf(const Rows<const std::uint8_t>& picture) {
    BlockNoise noise;
    noise.add(picture);
    return noise.take();
}

}  // namespace mfar
