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

// Like std::floor() and std::lround(), without a call of the C library for each sample.
int floored(float x) {
    const int towards0 = static_cast<int>(x);
    return towards0 - (x < static_cast<float>(towards0) ? 1 : 0);
}
int rounded(float x) {
    return static_cast<int>(double{x} + (x < 0 ? -0.5 : 0.5));
}

float sample(const AlignedRows<std::uint8_t>& picture, float x, float y) {
    const auto [width, height] = picture.size();
    const int floorX = floored(x), floorY = floored(y);
    const int left = floorX - 1, top = floorY - 1;
    const auto wx = catmullRom(x - static_cast<float>(floorX)),
               wy = catmullRom(y - static_cast<float>(floorY));
    const auto sum = [&](const auto& levelAt) {
        float out = 0;
        for (int j = 0; j < 4; ++j) {
            float row = 0;
            for (int i = 0; i < 4; ++i)
                row += wx[i] * static_cast<float>(levelAt(left + i, top + j));
            out += wy[j] * row;
        }
        return out;
    };
    const bool inside = left >= 0 && left + 4 <= width && top >= 0 && top + 4 <= height;
    if (inside) return sum([&](int column, int row) { return picture[row][column]; });
    return sum([&](int column, int row) {
        return picture[std::clamp(row, 0, height - 1)][std::clamp(column, 0, width - 1)];
    });
}

/// The two cells between which a position is interpolated along one axis. `at` is the position in
/// video px, and t is the weight of the second cell.
struct BetweenCells {
    BetweenCells(double position, int count) : at(position) {
        const double cell = std::clamp((at - 1.5) / kCell, 0.0, count - 1.0);
        first = std::min(static_cast<int>(cell), std::max(count - 2, 0));
        second = std::min(first + 1, count - 1);
        t = static_cast<float>(cell - first);
    }
    double at;
    int first, second;
    float t;
};

/// Divides each of `pixels` video pixels into `perPixel` parts, and returns the parts' centres.
std::vector<BetweenCells> partsOf(int pixels, int perPixel, int cells) {
    std::vector<BetweenCells> out;
    out.reserve(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(perPixel));
    for (int pixel = 0; pixel < pixels; ++pixel)
        for (int part = 0; part < perPixel; ++part)
            out.emplace_back(pixel - 0.5 + (part + 0.5) / perPixel, cells);
    return out;
}

LookUpCell between(const LookUpCell& a, const LookUpCell& b, float t, bool jumps) {
    if (jumps) t = t < 0.5F ? 0 : 1;
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.weight + t * (b.weight - a.weight)};
}

LookUpCell lookUpBetween(const AlignedRows<LookUpCell>& cells, const BetweenCells& u,
                         const BetweenCells& v) {
    const auto along = [&](int row) {
        const LookUpCell &left = cells[row][u.first], &right = cells[row][u.second];
        return between(left, right, u.t, left.jumpsRight());
    };
    const LookUpCell& above = cells[v.first][u.t < 0.5F ? u.first : u.second];
    return between(along(v.first), along(v.second), v.t, above.jumpsBelow());
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
    const std::vector<BetweenCells> columns = partsOf(video_.width, perPixel, lookUps.size().width);
    const std::vector<BetweenCells> rows = partsOf(video_.height, perPixel, lookUps.size().height);
    const auto valueAt = [&](const BetweenCells& u, const BetweenCells& v) {
        const LookUpCell offset = lookUpBetween(lookUps, u, v);
        const double sx = (u.at + 0.5) * pictures.scaleX - 0.5 + offset.x;
        const double sy = (v.at + 0.5) * pictures.scaleY - 0.5 + offset.y;
        return sample(pictures.still, static_cast<float>((sx + 0.5) * pictures.stillPerX - 0.5),
                      static_cast<float>((sy + 0.5) * pictures.stillPerY - 0.5));
    };
    for (int y = 0; y < video_.height && !stop.stop_requested(); ++y)
        for (int x = 0; x < video_.width; ++x) {
            if (known[y / kCell][x / kCell] == 0) continue;
            float sum = 0;
            for (int phase = 0; phase < kPhases; ++phase) {
                const BetweenCells* u = &columns[x * perPixel + phase % kGrid * samples];
                const BetweenCells* v = &rows[y * perPixel + phase / kGrid * samples];
                float value = 0;
                for (int row = 0; row < samples; ++row)
                    for (int column = 0; column < samples; ++column)
                        value += valueAt(u[column], v[row]);
                value /= static_cast<float>(samples * samples);
                sum += value;
                grid_[kGrid * y + phase / kGrid][kGrid * x + phase % kGrid] =
                    static_cast<std::int16_t>(rounded(std::clamp(value, -64.0F, 320.0F) * kScale));
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
    return lookUpBetween(cells, {px, cells.size().width}, {py, cells.size().height});
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

const std::array<Phases, kTaps>& cubicWeights() {
    static const std::array<Phases, kTaps> kWeights = [] {
        const std::int16_t* cubic = FilterBank::prior().cubic();
        std::array<Phases, kTaps> out;
        for (int tap = 0; tap < kTaps; ++tap)
            for (int phase = 0; phase < kPhases; ++phase)
                out[tap][phase] = double(cubic[filterIndex(tap, phase)]) / kWeightScale;
        return out;
    }();
    return kWeights;
}

}  // namespace mfar::enlarge
