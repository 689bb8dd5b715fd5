#include "pipeline/plan/rgb_planes.h"

#include "base/image_layout.h"
#include "pipeline/plan/tiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mfar {
namespace {

using ChannelRows = std::array<std::uint8_t*, 3>;

void splitRow(const std::uint8_t* from, int width, bool blueFirst, const ChannelRows& to) {
    std::uint8_t *first = to[blueFirst ? 2 : 0], *second = to[1], *third = to[blueFirst ? 0 : 2];
    for (int x = 0; x < width; ++x) {
        std::uint32_t pixel;
        std::memcpy(&pixel, from + 4 * static_cast<std::size_t>(x), 4);
        first[x] = static_cast<std::uint8_t>(pixel);
        second[x] = static_cast<std::uint8_t>(pixel >> 8);
        third[x] = static_cast<std::uint8_t>(pixel >> 16);
    }
}

/// The samples of Y, U or V. `step` is the distance between neighbouring samples of a row [bytes].
struct Samples {
    const std::uint8_t* data;
    std::size_t stride;
    int step;

    [[nodiscard]] const std::uint8_t* row(int y) const { return data + y * stride; }
};

std::array<Samples, 3> samplesOf(const ImageView& p) {
    const auto& [u, v] = p.chroma;
    if (p.format == PixelFormat::Yuyv)
        return {Samples{p.data, p.stride, 2}, {p.data + 1, p.stride, 4}, {p.data + 3, p.stride, 4}};
    const Samples luma{p.data, p.stride, 1};
    if (p.format == PixelFormat::Nv12)
        return {luma, {u.data, u.stride, 2}, {u.data + 1, u.stride, 2}};
    return {luma, {u.data, u.stride, 1}, {v.data, v.stride, 1}};
}

/// Converts Y U V to R G B in 16-bit integers, because every supported processor multiplies eight
/// of them at once.
class YuvRows {
public:
    explicit YuvRows(const ImageView& picture)
        : samples_(samplesOf(picture)), size_(picture.size),
          sharedRows_(picture.format != PixelFormat::Yuyv),
          half_(static_cast<std::size_t>(size_.width / 2) + 2), luma_(size_.width),
          chroma_{std::vector<std::int16_t>(size_.width), std::vector<std::int16_t>(size_.width)} {
        const YuvToRgb rows = yuvToRgb(picture.matrix, picture.range);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                factors_[i][j] = static_cast<std::int16_t>(std::lround(rows[i][j] * kOne));
            // Chroma is stored with an offset of 128, which readChroma() subtracts.
            const float offset = rows[i][3] + 128 * (rows[i][1] + rows[i][2]);
            offsets_[i] = static_cast<std::int16_t>(std::lround(16 * offset) + 8);
        }
    }

    void convert(int y, const ChannelRows& to) {
        const Samples& luma = samples_[0];
        const std::uint8_t* from = luma.row(y);
        for (int x = 0; x < size_.width; ++x)
            luma_[x] = static_cast<std::int16_t>(from[luma.step * x] << 7);
        readChroma(samples_[1], y, chroma_[0].data());
        readChroma(samples_[2], y, chroma_[1].data());
        for (std::size_t i = 0; i < 3; ++i)
            combine(factors_[i], offsets_[i], to[i]);
    }

private:
    static constexpr float kOne = 8192;

    /// Reads chroma as (value - 128) * 128. Chroma samples lie between the pixels that share them.
    /// Along each axis on which pixels share samples, a pixel gets 3/4 of the nearer sample and 1/4
    /// of the farther one.
    void readChroma(const Samples& plane, int y, std::int16_t* to) {
        const int width = size_.width / 2;
        const int row = sharedRows_ ? y / 2 : y;
        const int other =
            sharedRows_ ? std::clamp(y % 2 == 0 ? row - 1 : row + 1, 0, size_.height / 2 - 1) : row;
        const std::uint8_t *near = plane.row(row), *far = plane.row(other);
        std::int16_t* half = half_.data() + 1;
        for (int x = 0; x < width; ++x)
            half[x] =
                static_cast<std::int16_t>(3 * near[plane.step * x] + far[plane.step * x] - 512);
        half[-1] = half[0];
        half[width] = half[width - 1];
        for (int x = 0; x < width; ++x) {
            to[2 * x] = static_cast<std::int16_t>((3 * half[x] + half[x - 1]) * 8);
            to[2 * x + 1] = static_cast<std::int16_t>((3 * half[x] + half[x + 1]) * 8);
        }
    }

    void combine(const std::array<std::int16_t, 3>& factors, std::int16_t offset,
                 std::uint8_t* to) const {
        const auto times = [](std::int16_t a, std::int16_t b) {
            return static_cast<std::int16_t>((std::int32_t{a} * b) >> 16);
        };
        const std::int16_t *luma = luma_.data(), *u = chroma_[0].data(), *v = chroma_[1].data();
        for (int x = 0; x < size_.width; ++x) {
            const int sum = times(luma[x], factors[0]) + times(u[x], factors[1]) +
                            times(v[x], factors[2]) + offset;
            to[x] = static_cast<std::uint8_t>(std::clamp(sum >> 4, 0, 255));
        }
    }

    std::array<Samples, 3> samples_;
    Size size_;
    bool sharedRows_;
    std::array<std::array<std::int16_t, 3>, 3> factors_{};
    std::array<std::int16_t, 3> offsets_{};
    std::vector<std::int16_t> half_, luma_;
    std::array<std::vector<std::int16_t>, 2> chroma_;
};

}  // namespace

RgbPlanes::RgbPlanes(Size size)
    : size_(size), tiles_(tilesOf(size)), pitch_(kTileSize * tiles_.width) {
    for (auto& plane : planes_)
        plane.resize(static_cast<std::size_t>(pitch_) * kTileSize * tiles_.height);
}

RgbPlanes::ChannelRows RgbPlanes::rowsAt(int y) {
    const std::size_t at = static_cast<std::size_t>(y) * pitch_;
    return {planes_[0].data() + at, planes_[1].data() + at, planes_[2].data() + at};
}

void RgbPlanes::take(const ImageView& picture) {
    const auto rowOf = [&](int y) { return picture.data + y * picture.stride; };
    switch (picture.format) {
    case PixelFormat::Gray8:
        for (int y = 0; y < size_.height; ++y)
            for (std::uint8_t* to : rowsAt(y))
                std::copy_n(rowOf(y), size_.width, to);
        break;
    case PixelFormat::Rgba8:
    case PixelFormat::Bgra8:
        for (int y = 0; y < size_.height; ++y)
            splitRow(rowOf(y), size_.width, picture.format == PixelFormat::Bgra8, rowsAt(y));
        break;
    case PixelFormat::Yuyv:
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: {
        YuvRows rows(picture);
        for (int y = 0; y < size_.height; ++y)
            rows.convert(y, rowsAt(y));
    }
    }
    repeatBorder();
}

void RgbPlanes::repeatBorder() {
    const int rows = kTileSize * tiles_.height;
    for (auto& plane : planes_) {
        std::uint8_t* row = plane.data();
        for (int y = 0; y < size_.height; ++y, row += pitch_)
            std::fill(row + size_.width, row + pitch_, row[size_.width - 1]);
        for (int y = size_.height; y < rows; ++y, row += pitch_)
            std::copy_n(row - pitch_, pitch_, row);
    }
}

void RgbPlanes::takeTile(const RgbPlanes& from, int column, int row) {
    const std::size_t first =
        static_cast<std::size_t>(pitch_) * kTileSize * row + kTileSize * column;
    for (std::size_t c = 0; c < 3; ++c)
        for (int y = 0; y < kTileSize; ++y) {
            const std::size_t at = first + static_cast<std::size_t>(y) * pitch_;
            std::copy_n(from.planes_[c].data() + at, kTileSize, planes_[c].data() + at);
        }
}

}  // namespace mfar
