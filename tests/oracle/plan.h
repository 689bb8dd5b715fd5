#pragma once

#include "tests/oracle/luma.h"
#include "tests/oracle/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

/// Oracles of measureTiles(), markDrifted() and markBeside(), which find the tiles that changed.
namespace mfar::twin {

/// Measures of a tile. "Difference" is the new picture minus the picture that was drawn last.
struct TileChange {
    /// For each cell, row by row: absolute value of the mean difference, and mean of the absolute
    /// difference. Each is the largest value over red, green and blue.
    std::array<double, 16> mean{}, absolute{};
    /// Variance that noise gives to a cell's mean difference [grey levels^2]. Maximum over red,
    /// luma and blue.
    double cellNoise = 0;
    double noise = 0;  ///< standard deviation of the luma's noise [grey levels]
    /// Sum of the squared mean and the two squared slopes of the cells' mean differences, each
    /// divided by the variance that noise gives to it. Maximum over red, luma and blue.
    double moments = 0;
    /// Mean squares of three measures of the luma's difference (new minus last drawn picture):
    /// [0] twist() of single pixels, [1] 2 * (mean of 2x2 pixels), [2] 2 * (twist() of the means of
    /// 2x2 pixels). If the difference is white noise, each mean square is the noise's variance.
    std::array<double, 3> energy{};
    /// Sum of the squared residuals of a plane that is fitted to the luma's 2x2 means in a window
    /// of 8x8 pixels. Mean over nine windows.
    double structure = 0;
};

struct Difference {
    const TestPicture &now, &drawn;

    /// `colour`: 0 red, 1 green, 2 blue.
    [[nodiscard]] double of(int x, int y, int colour) const {
        if (x >= now.size.width || y >= now.size.height) return 0;
        const std::size_t i = 4 * (static_cast<std::size_t>(y) * now.size.width + x) + colour;
        return double(now.bytes[i]) - drawn.bytes[i];
    }
    /// `channel`: 0 red, 1 luma, 2 blue.
    [[nodiscard]] double at(int x, int y, int channel) const {
        if (channel != 1) return of(x, y, channel);
        return double{params::kLumaRed} * of(x, y, 0) + double{params::kLumaGreen} * of(x, y, 1) +
               double{params::kLumaBlue} * of(x, y, 2);
    }
    [[nodiscard]] double mean(int x, int y, int size, int channel) const {
        double sum = 0;
        for (int i = 0; i < size * size; ++i)
            sum += at(x + i % size, y + i / size, channel);
        return sum / (size * size);
    }
    /// Twist of 2x2 values, each of which is the mean of size x size pixels: half the difference
    /// between the sums of the two diagonals.
    [[nodiscard]] double twist(int x, int y, int size, int channel) const {
        return (mean(x, y, size, channel) - mean(x + size, y, size, channel) -
                mean(x, y + size, size, channel) + mean(x + size, y + size, size, channel)) /
               2;
    }
};

inline void driftOf(const Difference& d, int x0, int y0, double grain, TileChange& out) {
    for (int channel = 0; channel < 3; ++channel) {
        double variance = 0.17, sum = 0, slopeX = 0, slopeY = 0;
        for (int i = 0; i < 64; ++i)
            variance += std::pow(d.twist(x0 + 2 * (i % 8), y0 + 2 * (i / 8), 1, channel), 2) / 64;
        for (int i = 0; i < 16; ++i) {
            const int x = i % 4, y = i / 4;
            const double cell = d.mean(x0 + 4 * x, y0 + 4 * y, 4, channel);
            sum += cell;
            slopeX += (x - 1.5) * cell;
            slopeY += (y - 1.5) * cell;
        }
        const double squares = sum * sum / 16 + (slopeX * slopeX + slopeY * slopeY) / 20;
        out.cellNoise = std::max(out.cellNoise, variance / 16 * grain);
        out.moments = std::max(out.moments, squares / (variance / 16 * grain));
    }
    for (int i = 0; i < 64; ++i) {
        const int x = x0 + 2 * (i % 8), y = y0 + 2 * (i / 8);
        out.energy[0] += std::pow(d.twist(x, y, 1, 1), 2) / 64;
        out.energy[1] += 4 * std::pow(d.mean(x, y, 2, 1), 2) / 64;
    }
    for (int i = 0; i < 16; ++i)
        out.energy[2] += 4 * std::pow(d.twist(x0 + 4 * (i % 4), y0 + 4 * (i / 4), 2, 1), 2) / 16;
}

/// Fits a plane to 4x4 values by least squares. Returns the sum of the squared residuals.
inline double besidePlane(const std::array<double, 16>& v) {
    double mean = 0, dx = 0, dy = 0, out = 0;
    for (int i = 0; i < 16; ++i) {
        const int x = i % 4, y = i / 4;
        mean += v[i] / 16;
        dx += (x - 1.5) * v[i] / 20;
        dy += (y - 1.5) * v[i] / 20;
    }
    for (int i = 0; i < 16; ++i) {
        const int x = i % 4, y = i / 4;
        out += std::pow(v[i] - mean - (x - 1.5) * dx - (y - 1.5) * dy, 2);
    }
    return out;
}

inline double structureOf(const Grey& grey, int x0, int y0) {
    double out = 0;
    for (int place = 0; place < 9; ++place) {
        std::array<double, 16> v{};
        for (int i = 0; i < 64; ++i) {
            const int x = i % 8, y = i / 8;
            v[y / 2 * 4 + x / 2] +=
                grey.at(x0 + 4 * (place % 3) + x, y0 + 4 * (place / 3) + y) / 4.0;
        }
        out += besidePlane(v) / 9;
    }
    return out;
}

/// Change of the tile (tileX, tileY) from picture `drawn` to picture `now`. `grey`: luma of `now`.
/// `grain`: see Drift::beyondNoise().
inline TileChange tileChange(const TestPicture& now, const TestPicture& drawn, const Grey& grey,
                             int tileX, int tileY, double grain = 1) {
    TileChange out;
    const Difference d{now, drawn};
    driftOf(d, 16 * tileX, 16 * tileY, grain, out);
    out.structure = structureOf(grey, 16 * tileX, 16 * tileY);
    for (int cell = 0; cell < 16; ++cell) {
        const int x0 = 16 * tileX + 4 * (cell % 4), y0 = 16 * tileY + 4 * (cell / 4);
        for (int channel = 0; channel < 3; ++channel) {
            double sum = 0, absolute = 0;
            for (int i = 0; i < 16; ++i) {
                const double by = d.of(x0 + i % 4, y0 + i / 4, channel);
                sum += by / 16;
                absolute += std::abs(by) / 16;
            }
            out.mean[cell] = std::max(out.mean[cell], std::abs(sum));
            out.absolute[cell] = std::max(out.absolute[cell], absolute);
        }
        for (int y = y0; y < y0 + 4; y += 2)
            for (int x = x0; x < x0 + 4; x += 2)
                out.noise += std::abs(grey.at(x, y) - grey.at(x + 1, y) - grey.at(x, y + 1) +
                                      grey.at(x + 1, y + 1)) /
                             2 / 64;
    }
    out.noise *= 1.2533;  // ratio of a Gaussian's standard deviation to its mean absolute value
    return out;
}

/// A tile counts as changed if its TileChange::moments exceeds kMoments, or if one of its cells
/// changed. A cell changed if TileChange::absolute exceeds `absolute`, or if TileChange::mean
/// exceeds `mean` and its square exceeds kCell * TileChange::cellNoise.
struct ChangeBounds {
    double mean, absolute;
    static constexpr double kMoments = 40, kCell = 30;

    [[nodiscard]] bool surely(const TileChange& t, int cell) const {
        const double m = t.mean[cell];
        return (m > mean && m * m > kCell * t.cellNoise) || t.absolute[cell] > absolute;
    }
    [[nodiscard]] bool surely(const TileChange& t) const {
        bool out = t.moments > kMoments;
        for (int cell = 0; cell < 16; ++cell)
            out = out || surely(t, cell);
        return out;
    }
    [[nodiscard]] bool isClose(const TileChange& t) const {
        bool out = std::abs(t.moments - kMoments) < 1e-2;
        for (int cell = 0; cell < 16; ++cell)
            out = out || std::abs(t.mean[cell] - mean) < 1e-3 ||
                  std::abs(t.absolute[cell] - absolute) < 1e-3 ||
                  std::abs(t.mean[cell] * t.mean[cell] - kCell * t.cellNoise) < 1e-2;
        return out;
    }
};

/// Sums TileChange::energy over the tiles that do not count as changed by ChangeBounds. If the sum
/// of energy[1] is larger than that of white noise with the same energy[0], all these tiles count
/// as changed.
class Drift {
public:
    void add(const TileChange& t) {
        ++tiles_;
        pixels_ += t.energy[0];
        means_ += t.energy[1];
    }
    /// Above 0 if the added tiles count as changed. `grain`: ratio of the noise's energy in 2x2
    /// means (energy[1]) to that in pixels (energy[0]).
    [[nodiscard]] double beyondNoise(double grain = 1) const {
        const double room = std::max(5 * 0.27 / std::sqrt(std::max(tiles_, 1)), 0.03);
        return means_ - (1 + room) * grain * pixels_ - 0.01 * tiles_;
    }

private:
    int tiles_ = 0;
    double pixels_ = 0, means_ = 0;
};

/// True if a cell of tile (x, y) that exceeds `bounds` is inside tile (i, j) or next to it.
inline bool reaches(const TileChange& t, const ChangeBounds& bounds, int x, int y, int i, int j) {
    for (int cell = 0; cell < 16; ++cell) {
        const int column = 4 * x + cell % 4, row = 4 * y + cell / 4;
        const bool isBeside =
            column >= 4 * i - 1 && column <= 4 * i + 4 && row >= 4 * j - 1 && row <= 4 * j + 4;
        if (isBeside && bounds.surely(t, cell)) return true;
    }
    return false;
}

/// For each tile, row by row: true if it changed, empty if only rounding decides.
inline std::vector<std::optional<bool>> changedTiles(const std::vector<TileChange>& tiles,
                                                     int columns, const ChangeBounds& bounds) {
    constexpr int kBlock = 8;
    const int rows = static_cast<int>(tiles.size()) / columns;
    const auto clear = [](double beyond) { return std::abs(beyond) > 0.01; };
    bool known = true;
    Drift all;
    for (const TileChange& t : tiles) {
        if (bounds.isClose(t)) known = false;
        if (!bounds.surely(t)) all.add(t);
    }
    known = known && clear(all.beyondNoise());
    std::vector<std::optional<bool>> out(tiles.size());
    for (int i = 0; known && i < static_cast<int>(tiles.size()); ++i) {
        const int x0 = i % columns / kBlock * kBlock, y0 = i / columns / kBlock * kBlock;
        Drift block;
        for (int y = y0; y < std::min(y0 + kBlock, rows); ++y)
            for (int x = x0; x < std::min(x0 + kBlock, columns); ++x)
                if (!bounds.surely(tiles[y * columns + x])) block.add(tiles[y * columns + x]);
        const bool drifts = all.beyondNoise() > 0 || block.beyondNoise() > 0;
        if (bounds.surely(tiles[i]) || drifts || clear(block.beyondNoise()))
            out[i] = bounds.surely(tiles[i]) || drifts;
    }
    for (int i = 0; known && i < static_cast<int>(tiles.size()); ++i) {
        const int column = i % columns, row = i / columns;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y)
            for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns - 1); ++x)
                if (reaches(tiles[y * columns + x], bounds, x, y, column, row)) out[i] = true;
    }
    return out;
}

}  // namespace mfar::twin
