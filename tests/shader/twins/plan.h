#pragma once

#include "tests/shader/pictures.h"
#include "tests/shader/twins/luma.h"

#include <array>

/// Scalar twin of plan_change.comp.
namespace mfar::twin {

struct TileChange {
    /// Largest over the tile's cells and the channels: mean difference, mean absolute difference.
    double mean = 0, absolute = 0;
    double noise = 0;  ///< [grey levels]
};

inline TileChange tileChange(Picture now, Picture drawn, int tileX, int tileY) {
    const auto pixel = [](Picture& p, int x, int y) {
        return p.at(std::min(x, p.size.width - 1), std::min(y, p.size.height - 1));
    };
    const Grey grey = luma(now.view());
    TileChange out;
    for (int cell = 0; cell < 16; ++cell) {
        const int x0 = 16 * tileX + 4 * (cell % 4), y0 = 16 * tileY + 4 * (cell / 4);
        for (int channel = 0; channel < 3; ++channel) {
            double sum = 0, absolute = 0;
            for (int i = 0; i < 16; ++i) {
                const int x = x0 + i % 4, y = y0 + i / 4;
                const double d = double(pixel(now, x, y)[channel]) - pixel(drawn, x, y)[channel];
                sum += d / 16;
                absolute += std::abs(d) / 16;
            }
            out.mean = std::max(out.mean, std::abs(sum));
            out.absolute = std::max(out.absolute, absolute);
        }
        for (int y = y0; y < y0 + 4; y += 2)
            for (int x = x0; x < x0 + 4; x += 2)
                out.noise += std::abs(grey.at(x, y) - grey.at(x + 1, y) - grey.at(x, y + 1) +
                                      grey.at(x + 1, y + 1)) /
                             2 / 64;
    }
    out.noise *= 1.2533;  // mean absolute value of a Gaussian to its deviation
    return out;
}

}  // namespace mfar::twin
