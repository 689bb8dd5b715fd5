#include "pipeline/enlarge/warped_grid.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::enlarge {
namespace {

std::array<float, 4> catmullRom(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5F * (-t3 + 2 * t2 - t), 0.5F * (3 * t3 - 5 * t2 + 2), 0.5F * (-3 * t3 + 4 * t2 + t),
            0.5F * (t3 - t2)};
}

float sample(const AlignedRows<std::uint8_t>& picture, float x, float y) {
    const auto [width, height] = picture.size();
    const float floorX = std::floor(x), floorY = std::floor(y);
    const int left = static_cast<int>(floorX) - 1, top = static_cast<int>(floorY) - 1;
    const auto wx = catmullRom(x - floorX), wy = catmullRom(y - floorY);
    float out = 0;
    for (int j = 0; j < 4; ++j) {
        const std::uint8_t* row = picture[std::clamp(top + j, 0, height - 1)];
        float sum = 0;
        for (int i = 0; i < 4; ++i)
            sum += wx[i] * static_cast<float>(row[std::clamp(left + i, 0, width - 1)]);
        out += wy[j] * sum;
    }
    return out;
}

/// The two cells between which a position is interpolated along one axis. `at` is the position in
/// video px, and t is the weight of the second cell.
struct BetweenCells {
    BetweenCells(double at, int count) {
        const double cell = std::clamp((at - 1.5) / kCell, 0.0, count - 1.0);
        first = std::min(static_cast<int>(cell), std::max(count - 2, 0));
        second = std::min(first + 1, count - 1);
        t = static_cast<float>(cell - first);
    }
    int first, second;
    float t;
};

LookUpCell between(const LookUpCell& a, const LookUpCell& b, float t, bool jumps) {
    if (jumps) t = t < 0.5F ? 0 : 1;
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.weight + t * (b.weight - a.weight)};
}

}  // namespace

WarpedGrid::WarpedGrid(Size video)
    : video_(video), grid_({kGrid * video.width, kGrid * video.height}),
      mean_(static_cast<std::size_t>(video.width) * video.height) {}

void WarpedGrid::warp(const MatchedPictures& pictures, const AlignedRows<LookUpCell>& lookUps,
                      const AlignedRows<std::uint8_t>& known, const std::stop_token& stop) {
    const int samples =
        std::max(1, static_cast<int>(std::lround(pictures.scaleX * pictures.stillPerX / kGrid)));
    const int perPixel = kGrid * samples;
    const auto valueAt = [&](double px, double py) {
        const LookUpCell offset = lookUpAt(lookUps, px, py);
        const double sx = (px + 0.5) * pictures.scaleX - 0.5 + offset.x;
        const double sy = (py + 0.5) * pictures.scaleY - 0.5 + offset.y;
        return sample(pictures.still, static_cast<float>((sx + 0.5) * pictures.stillPerX - 0.5),
                      static_cast<float>((sy + 0.5) * pictures.stillPerY - 0.5));
    };
    for (int y = 0; y < video_.height && !stop.stop_requested(); ++y)
        for (int x = 0; x < video_.width; ++x) {
            if (known[y / kCell][x / kCell] == 0) continue;
            float sum = 0;
            for (int phase = 0; phase < kPhases; ++phase) {
                float value = 0;
                for (int k = 0; k < samples * samples; ++k) {
                    const int column = phase % kGrid * samples + k % samples,
                              row = phase / kGrid * samples + k / samples;
                    value += valueAt(x - 0.5 + (column + 0.5) / perPixel,
                                     y - 0.5 + (row + 0.5) / perPixel);
                }
                value /= static_cast<float>(samples * samples);
                sum += value;
                grid_[kGrid * y + phase / kGrid][kGrid * x + phase % kGrid] =
                    static_cast<std::int16_t>(
                        std::lround(std::clamp(value, -64.0F, 320.0F) * kScale));
            }
            mean_[static_cast<std::size_t>(y) * video_.width + x] = sum / kPhases;
        }
}

float WarpedGrid::rootAboveMean(int x, int y) const {
    float sum = 0, squares = 0;
    for (int phase = 0; phase < kPhases; ++phase) {
        const float value = at(x, y, phase);
        sum += value;
        squares += value * value;
    }
    return std::max(std::sqrt(squares / kPhases) - sum / kPhases, 0.0F);
}

LookUpCell lookUpAt(const AlignedRows<LookUpCell>& cells, double px, double py) {
    const BetweenCells u(px, cells.size().width), v(py, cells.size().height);
    const auto along = [&](int row) {
        const LookUpCell &left = cells[row][u.first], &right = cells[row][u.second];
        return between(left, right, u.t, left.jumpsRight());
    };
    const LookUpCell& above = cells[v.first][u.t < 0.5F ? u.first : u.second];
    return between(along(v.first), along(v.second), v.t, above.jumpsBelow());
}

Phases weightsAt(const AlignedRows<LookUpCell>& cells, int x, int y) {
    Phases out;
    for (int phase = 0; phase < kPhases; ++phase) {
        const int row = phase / kGrid, column = phase % kGrid;
        out[phase] =
            lookUpAt(cells, x - 0.5 + (column + 0.5) / kGrid, y - 0.5 + (row + 0.5) / kGrid).weight;
    }
    return out;
}

}  // namespace mfar::enlarge
