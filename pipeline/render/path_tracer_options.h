#pragma once

#include <cstdint>

namespace mfar {

/// Distribution of a pixel's random sample positions around the pixel's centre.
enum class PixelFilter {
    Box,   ///< uniform over the pixel
    Tent,  ///< falls to 0 at the centres of the neighbouring pixels
};

struct PathTracerOptions {
    int maxDepth = 6;  ///< largest number of surfaces on a path, including the first; [1, 64]
    /// Russian roulette may end a path after this number of surfaces; at least 1.
    int rouletteDepth = 3;
    /// Upper limit of each colour channel of the indirect light that each surface on a path adds to
    /// a pixel; 0: no limit.
    float fireflyClamp = 0;
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    /// If true, the random numbers are independent instead of a Sobol sequence.
    bool independentSamples = false;
    /// If true, light of emissive triangles is found only where a path hits them by chance.
    bool emissionByChance = false;
    /// Distance from the objects' centre within which the shadow catcher is traced, divided by half
    /// the diagonal of the objects' common box; at least 1. Glowing objects increase this distance
    /// by the factor glowReach().
    float shadowReach = 3;
    int buildThreads = 1;  ///< threads that build the search structure; [1, 64]
    bool operator==(const PathTracerOptions&) const = default;
};

/// Throws std::invalid_argument if an option is out of range. The message names the first such
/// option.
void validate(const PathTracerOptions& options);

}  // namespace mfar
