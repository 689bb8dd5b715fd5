#pragma once

#include <cstdint>

namespace mfar {

/// The part of a pixel's surroundings that its samples are drawn from.
enum class PixelFilter {
    Box,   ///< the pixel itself
    Tent,  ///< falls to 0 at the neighbours' centres
};

struct PathTracerOptions {
    int maxDepth = 6;        ///< surfaces on a path, the camera's first included; [1, 64]
    int rouletteDepth = 3;   ///< surfaces after which a path may end by chance; at least 1
    float fireflyClamp = 0;  ///< limit of an indirect contribution's brightest channel; 0: none
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    bool independentSamples = false;  ///< random numbers in place of the Sobol sequence
    float shadowReach = 3;  ///< objects' radii around them in which the catcher counts; at least 1
    int buildThreads = 1;   ///< for the search structure; [1, 64]
    bool operator==(const PathTracerOptions&) const = default;
};

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const PathTracerOptions& options);

}  // namespace mfar
