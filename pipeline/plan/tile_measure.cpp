#include "pipeline/plan/tile_measure.h"

#include "pipeline/plan/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

constexpr float kMeanToDeviation = 1.2533F;  // of the absolute value of a Gaussian
// Of mean and both slopes, each squared over its variance: 1e-8 of tiles at rest are beyond.
constexpr float kSurelyChanged = 40;
// Of a cell's mean, likewise.
constexpr float kCellSurelyChanged = 30;
constexpr float kByteRounding = 0.17F;  // variance of the difference of two pixels of 8 bits

constexpr int kBlocks = kTileSize / 2;  // of 2x2 pixels, a side of a tile
constexpr int kCells = 4;               // of 4x4 pixels, likewise

constexpr std::array<float, 3> kLuma{0.299F, 0.587F, 0.114F};  // Rec. 601

float lumaOf(float red, float green, float blue) {
    return kLuma[0] * red + kLuma[1] * green + kLuma[2] * blue;
}

/// Blocks of 2x2 pixels: a channel's sums and twists times two, and sums of absolute values.
struct Blocks {
    explicit Blocks(std::size_t count) : sum(count), twist(count), absolute(count) {}
    std::vector<std::int16_t> sum, twist, absolute;
};

/// Of two rows.
template <class Pixel>
void sumBlocks(const Pixel* top, const Pixel* bottom, std::size_t count, std::int16_t* sum,
               std::int16_t* twist) {
    for (std::size_t i = 0; i < count; ++i) {
        const int a = top[2 * i], b = top[2 * i + 1], c = bottom[2 * i], d = bottom[2 * i + 1];
        sum[i] = static_cast<std::int16_t>(a + b + c + d);
        twist[i] = static_cast<std::int16_t>(a - b - c + d);
    }
}

void sumAbsolute(const std::int16_t* top, const std::int16_t* bottom, std::size_t count,
                 std::int16_t* to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = static_cast<std::int16_t>(std::abs(top[2 * i]) + std::abs(top[2 * i + 1]) +
                                          std::abs(bottom[2 * i]) + std::abs(bottom[2 * i + 1]));
}

/// What a row of tiles is measured by, block by block: planes of 8 rows.
class BlockRow {
public:
    explicit BlockRow(const RgbPlanes& like)
        : width_(like.size().width), height_(like.size().height),
          pitch_(static_cast<std::size_t>(like.pitch()) / 2),
          difference_{Blocks(kBlocks * pitch_), Blocks(kBlocks * pitch_), Blocks(kBlocks * pitch_)},
          light_(kBlocks * pitch_), rough_(kBlocks * pitch_), lumaSum_(kBlocks * pitch_),
          lumaTwist_(kBlocks * pitch_), top_(2 * pitch_), bottom_(2 * pitch_), sum_(pitch_),
          twist_(pitch_) {}

    void read(const RgbPlanes& now, const RgbPlanes& drawn, int tileRow) {
        std::ranges::fill(light_, 0.0F);
        std::ranges::fill(rough_, 0.0F);
        for (int b = 0; b < kBlocks; ++b)
            for (int channel = 0; channel < 3; ++channel)
                readRows(now, drawn, channel, kTileSize * tileRow + 2 * b, b * pitch_);
        for (float& rough : rough_)
            rough = std::abs(rough);
        const auto& [red, green, blue] = difference_;
        for (std::size_t i = 0; i < lumaSum_.size(); ++i) {
            lumaSum_[i] = lumaOf(red.sum[i], green.sum[i], blue.sum[i]);
            lumaTwist_[i] = lumaOf(red.twist[i], green.twist[i], blue.twist[i]);
        }
    }

    [[nodiscard]] TileMeasure measure(int column, const ChangeBounds& bounds) const;

private:
    void readRows(const RgbPlanes& now, const RgbPlanes& drawn, int channel, int y,
                  std::size_t first);
    void subtract(const std::uint8_t* now, const std::uint8_t* drawn, bool inside,
                  std::int16_t* to) const;

    [[nodiscard]] float structureOf(std::size_t first) const;
    [[nodiscard]] std::array<float, 3> noiseOf(std::size_t first) const;
    [[nodiscard]] std::uint16_t changedCells(std::size_t first, const std::array<float, 3>& ofCell,
                                             const ChangeBounds& bounds) const;
    [[nodiscard]] bool leans(std::size_t first, const std::array<float, 3>& ofCell) const;

    int width_, height_;
    std::size_t pitch_;  // blocks
    std::array<Blocks, 3> difference_;
    std::vector<float> light_;                // 2x2 means of the video's luma
    std::vector<float> rough_;                // its twist, without sign
    std::vector<float> lumaSum_, lumaTwist_;  // of the difference
    std::vector<std::int16_t> top_, bottom_;  // differences of two rows
    std::vector<std::int16_t> sum_, twist_;   // of the video, in one channel
};

// Beyond the border there is no difference: repeated noise would look like a change.
void BlockRow::subtract(const std::uint8_t* now, const std::uint8_t* drawn, bool inside,
                        std::int16_t* to) const {
    const int width = inside ? width_ : 0;
    for (int x = 0; x < width; ++x)
        to[x] = static_cast<std::int16_t>(now[x] - drawn[x]);
    std::fill(to + width, to + 2 * pitch_, std::int16_t{0});
}

void BlockRow::readRows(const RgbPlanes& now, const RgbPlanes& drawn, int channel, int y,
                        std::size_t first) {
    const std::uint8_t *upper = now.row(channel, y), *lower = now.row(channel, y + 1);
    subtract(upper, drawn.row(channel, y), y < height_, top_.data());
    subtract(lower, drawn.row(channel, y + 1), y + 1 < height_, bottom_.data());
    Blocks& to = difference_[static_cast<std::size_t>(channel)];
    sumBlocks(top_.data(), bottom_.data(), pitch_, &to.sum[first], &to.twist[first]);
    sumAbsolute(top_.data(), bottom_.data(), pitch_, &to.absolute[first]);
    sumBlocks(upper, lower, pitch_, sum_.data(), twist_.data());
    const float share = kLuma[static_cast<std::size_t>(channel)];
    for (std::size_t i = 0; i < pitch_; ++i) {
        light_[first + i] += share / 4 * static_cast<float>(sum_[i]);
        rough_[first + i] += share / 2 * static_cast<float>(twist_[i]);
    }
}

/// Of 4x4 values.
float besidePlane(const float* values, std::size_t pitch) {
    float sum = 0, squares = 0, slopeX = 0, slopeY = 0;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const float v = values[y * pitch + x] - values[0];
            sum += v;
            squares += v * v;
            slopeX += (x - 1.5F) * v;
            slopeY += (y - 1.5F) * v;
        }
    return std::max(squares - sum * sum / 16 - (slopeX * slopeX + slopeY * slopeY) / 20, 0.0F);
}

float BlockRow::structureOf(std::size_t first) const {
    float sum = 0;
    for (std::size_t place = 0; place < 9; ++place)
        sum += besidePlane(&light_[first + 2 * (place / 3) * pitch_ + 2 * (place % 3)], pitch_);
    return sum / 9;
}

/// Variance of the difference's pixels, by their twist: red, luma, blue.
std::array<float, 3> BlockRow::noiseOf(std::size_t first) const {
    std::int32_t red = 0, blue = 0;
    float luma = 0;
    for (std::size_t y = 0; y < kBlocks; ++y)
        for (std::size_t x = 0; x < kBlocks; ++x) {
            const std::size_t i = first + y * pitch_ + x;
            const std::int32_t r = difference_[0].twist[i], b = difference_[2].twist[i];
            red += r * r;
            blue += b * b;
            luma += lumaTwist_[i] * lumaTwist_[i];
        }
    return {static_cast<float>(red) / 256, luma / 256, static_cast<float>(blue) / 256};
}

/// Cells of a tile.
template <class T>
using CellsOf = std::array<T, std::size_t{kCells} * kCells>;

template <class To, class From>
CellsOf<To> cellSums(const From* blocks, std::size_t pitch) {
    CellsOf<To> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const From* at = blocks + 2 * (i / kCells) * pitch + 2 * (i % kCells);
        out[i] = To{at[0]} + at[1] + at[pitch] + at[pitch + 1];
    }
    return out;
}

/// Mean and slopes of the cells' means, squared, over their variance.
template <class T>
float momentsOf(const CellsOf<T>& sums, float variance) {
    float sum = 0, slopeX = 0, slopeY = 0;
    for (int i = 0; i < static_cast<int>(sums.size()); ++i) {
        const float mean = static_cast<float>(sums[i]) / 16;
        sum += mean;
        const int row = i / kCells, column = i % kCells;
        slopeX += (static_cast<float>(column) - 1.5F) * mean;
        slopeY += (static_cast<float>(row) - 1.5F) * mean;
    }
    return (sum * sum / 16 + (slopeX * slopeX + slopeY * slopeY) / 20) / variance;
}

/// Variance of a cell's mean by noise: red, luma, blue.
std::array<float, 3> ofCells(std::array<float, 3> variance, float grain) {
    for (float& v : variance)
        v = (v + kByteRounding) / 16 * grain;
    return variance;
}

std::uint16_t BlockRow::changedCells(std::size_t first, const std::array<float, 3>& ofCell,
                                     const ChangeBounds& bounds) const {
    const float noisiest = kCellSurelyChanged * std::ranges::max(ofCell);
    std::uint16_t out = 0;
    for (const Blocks& channel : difference_) {
        const auto sums = cellSums<std::int32_t>(&channel.sum[first], pitch_);
        const auto absolute = cellSums<std::int32_t>(&channel.absolute[first], pitch_);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const float mean = static_cast<float>(std::abs(sums[i])) / 16;
            if (static_cast<float>(absolute[i]) / 16 > bounds.absolute ||
                (mean > bounds.mean && mean * mean > noisiest))
                out = static_cast<std::uint16_t>(out | 1U << i);
        }
    }
    return out;
}

bool BlockRow::leans(std::size_t first, const std::array<float, 3>& ofCell) const {
    float moments = momentsOf(cellSums<float>(&lumaSum_[first], pitch_), ofCell[1]);
    for (const std::size_t channel : {0, 2})
        moments = std::max(
            moments, momentsOf(cellSums<std::int32_t>(&difference_[channel].sum[first], pitch_),
                               ofCell[channel]));
    return moments > kSurelyChanged;
}

TileMeasure BlockRow::measure(int column, const ChangeBounds& bounds) const {
    const std::size_t first = std::size_t{kBlocks} * column;
    const std::array<float, 3> variance = noiseOf(first);
    TileMeasure out;
    const std::array<float, 3> ofCell = ofCells(variance, bounds.grain);
    out.changedCells = changedCells(first, ofCell, bounds);
    out.changed = out.changedCells != 0 || leans(first, ofCell);
    out.structure = structureOf(first);
    out.pixels = variance[1];
    for (std::size_t y = 0; y < kBlocks; ++y)
        for (std::size_t x = 0; x < kBlocks; ++x) {
            const std::size_t i = first + y * pitch_ + x;
            out.noise += rough_[i];
            out.means += lumaSum_[i] * lumaSum_[i];
        }
    out.noise *= kMeanToDeviation / 64;
    out.means /= 256;
    for (std::size_t i = 0; i < 16; ++i) {
        const float* at = &lumaSum_[first + 2 * (i / kCells) * pitch_ + 2 * (i % kCells)];
        const float bend = (at[0] - at[1] - at[pitch_] + at[pitch_ + 1]) / 8;
        out.bends += bend * bend / 4;
    }
    return out;
}

}  // namespace

void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out) {
    const Size tiles = now.tiles();
    out.resize(static_cast<std::size_t>(tiles.width) * tiles.height);
    const auto measureRows = [&](int begin, int end) {
        BlockRow blocks(now);
        for (int row = begin; row < end; ++row) {
            blocks.read(now, drawn, row);
            for (int column = 0; column < tiles.width; ++column)
                out[static_cast<std::size_t>(row) * tiles.width + column] =
                    blocks.measure(column, bounds);
        }
    };
    if (workers)
        workers->forRange(tiles.height, 4, measureRows);
    else
        measureRows(0, tiles.height);
}

}  // namespace mfar
