#pragma once

#include "tests/oracle/enlarge.h"

/// Oracle, in double precision, of how a still is prepared and what it contributes to a frame.
/// Values are grey levels.
namespace mfar::twin {

/// Samples the function at(x, y); x and y are in pixels of `grid`, and the centre of the first
/// pixel is (0.5, 0.5). A pixel is the mean of 4x4 samples in an area of footprintX x footprintY
/// pixels.
template <class At>
Grey seen(Size grid, const At& at, double footprintX = params::kSeen,
          double footprintY = params::kSeen) {
    return greyOf(grid, [&](int x, int y) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const int column = i % 4, row = i / 4;
            sum += at(x + 0.5 + footprintX * (column - 1.5) / 4,
                      y + 0.5 + footprintY * (row - 1.5) / 4);
        }
        return sum / 16;
    });
}

/// Like seen(), for a warped still of the output's size. Bilinear look-ups blur the warped still,
/// so the footprint is smaller than that of seen(): look-ups and footprint together have the
/// variance of the footprint of seen().
inline Grey seenOf(const Grey& warped, Size video) {
    const double stepX = static_cast<double>(warped.size.width) / video.width,
                 stepY = static_cast<double>(warped.size.height) / video.height;
    const auto footprint = [](double step) {
        const double samples = (1.5 * 1.5 + 0.5 * 0.5) / 2 / 16, tent = 1.0 / 6;
        return std::sqrt(
            std::max(params::kSeen * params::kSeen - tent / samples / (step * step), 0.0));
    };
    return seen(
        video,
        [&](double x, double y) { return warped.bilinear(x * stepX - 0.5, y * stepY - 0.5); },
        footprint(stepX), footprint(stepY));
}

/// Amplifies the finest detail of luma. Each of the four neighbours of a pixel is subtracted with
/// the weight `neighbours`.
inline Grey raised(const Grey& luma, double neighbours) {
    return greyOf(luma.size, [&](int x, int y) {
        const double beside =
            luma.at(x - 1, y) + luma.at(x + 1, y) + luma.at(x, y - 1) + luma.at(x, y + 1);
        return luma.at(x, y) + neighbours * (4 * luma.at(x, y) - beside);
    });
}

/// Removes noise from luma with a Wiener filter over 3x3 pixels. `noise`: variance that is removed.
inline Grey quiet(const Grey& luma, double noise) {
    return greyOf(luma.size, [&](int x, int y) {
        double sum = 0, squares = 0;
        for (int i = 0; i < 9; ++i) {
            const double value = luma.at(x + i % 3 - 1, y + i / 3 - 1);
            sum += value;
            squares += value * value;
        }
        const double mean = sum / 9, variance = squares / 9 - mean * mean;
        const double kept = variance > noise ? 1 - noise / variance : 0;
        return mean + kept * (luma.at(x, y) - mean);
    });
}

/// Reduces a picture along both axes with a tent filter that is two result pixels wide.
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
