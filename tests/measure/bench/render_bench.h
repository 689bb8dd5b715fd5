#pragma once

#include <string>
#include <vector>

namespace mfar::bench {

/// Rays and samples per second in one thread, for a 640x480 camera that looks at a sphere. `bare`:
/// Embree's rtcIntersect1 in a plain loop. `ours`: mfar's camera rays, traced in packets; the time
/// includes computing their directions through the lens. `samples`: paths that end at the sphere,
/// a matt surface in sunlight.
struct RayRates {
    int triangles = 0;
    double bare = 0, ours = 0;  ///< [million rays/s]
    double samples = 0;         ///< [million samples/s]
};

/// RMS error of a picture's radiance at 16 samples per pixel. `ours`: with mfar's random numbers.
/// `independent`: with PathTracerOptions::independentSamples.
struct SamplingError {
    std::string scene;
    double ours = 0, independent = 0;
};

struct RenderFigures {
    std::vector<RayRates> rates;
    std::vector<SamplingError> errors;
};

/// `quick`: small pictures, only to check that the program runs. Returns an empty result if the
/// path tracer is not built.
[[nodiscard]] RenderFigures measureRender(bool quick);

}  // namespace mfar::bench
