#pragma once

#include <cstdint>

namespace mfar {

/// The distribution of the random positions of a pixel's samples around the pixel's centre.
enum class PixelFilter {
    Box,   ///< uniform over the pixel itself
    Tent,  ///< falls to 0 at the centres of the neighbouring pixels
};

struct PathTracerOptions {
    int maxDepth = 6;       ///< largest number of surfaces on a path, including the first; [1, 64]
    int rouletteDepth = 3;  ///< surfaces after which Russian roulette may end a path; at least 1
    /// Upper limit of the brightest colour channel of indirect light that a path adds to a pixel;
    /// 0: no limit.
    float fireflyClamp = 0;
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    bool independentSamples = false;  ///< independent random numbers instead of the Sobol sequence
    float shadowReach = 3;  ///< the shadow catcher is traced within this radius around an object
                            ///< [object radii]; at least 1
    int buildThreads = 1;   ///< threads that build the search structure; [1, 64]
    bool operator==(const PathTracerOptions&) const = default;
};

/// Throws std::invalid_argument whose message names the first option that is out of range.
void validate(const PathTracerOptions& options);

}  // namespace mfar
