#pragma once

#include "tests/oracle/upscale.h"

/// What a still is made into before it is used, in double precision and grey levels.
namespace mfar::twin {

inline constexpr double kLowFootprint = 1.25;  // in pixels of the low picture

/// The still's luma on a coarser grid: mean of 4x4 bilinear taps over the footprint.
inline Grey stillLow(const Grey& still, Size low, double footprint = kLowFootprint) {
    return greyOf(low, [&](int x, int y) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const int column = i % 4, row = i / 4;
            const double dx = footprint * (column - 1.5) / 4;
            const double dy = footprint * (row - 1.5) / 4;
            sum += still.bilinear((x + 0.5 + dx) * still.size.width / low.width - 0.5,
                                  (y + 0.5 + dy) * still.size.height / low.height - 0.5);
        }
        return sum / 16;
    });
}

/// Luma with its finest detail raised; `neighbours`: weight of the four of a pixel.
inline Grey raised(const Grey& luma, double neighbours) {
    return greyOf(luma.size, [&](int x, int y) {
        const double beside =
            luma.at(x - 1, y) + luma.at(x + 1, y) + luma.at(x, y - 1) + luma.at(x, y + 1);
        return luma.at(x, y) + neighbours * (4 * luma.at(x, y) - beside);
    });
}

/// What a picture of `low` pixels cannot show of the still, about 128; `neighbours` as raised().
inline Grey stillDetail(const Grey& luma, Size low, double neighbours) {
    const Grey up = enlarged(stillLow(luma, low), luma.size), fine = raised(luma, neighbours);
    return greyOf(luma.size, [&](int x, int y) { return fine.at(x, y) - up.at(x, y) + 128; });
}

/// Tent filter along both axes, as wide as two pixels of the result.
inline Grey reduced(const Grey& g, Size to) {
    const auto along = [](int from, int wanted, int i, const auto& valueAt) {
        const double scale = static_cast<double>(from) / wanted, at = centre(i, from, wanted);
        double sum = 0, weights = 0;
        for (int k = static_cast<int>(std::floor(at - scale)); k <= at + scale; ++k) {
            const double weight = std::max(0.0, scale - std::abs(k - at));
            sum += weight * valueAt(k);
            weights += weight;
        }
        return sum / weights;
    };
    const Grey narrow = greyOf({to.width, g.size.height}, [&](int x, int y) {
        return along(g.size.width, to.width, x, [&](int k) { return g.at(k, y); });
    });
    return greyOf(to, [&](int x, int y) {
        return along(g.size.height, to.height, y, [&](int k) { return narrow.at(x, k); });
    });
}

}  // namespace mfar::twin
