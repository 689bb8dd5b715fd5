#pragma once

#include <string>
#include <vector>

namespace mfar::bench {

/// First hits of a 640x480 camera on a sphere, one thread, the same rays: Embree's rtcIntersect1 in
/// a plain loop, our camera rays with lens and packets, and complete samples in matt sunlight.
struct RayRates {
    int triangles = 0;
    double bare = 0, ours = 0;  ///< [Mray/s]
    double samples = 0;         ///< [Msample/s], for the whole picture
};

/// Root mean square error of the picture's radiance at 16 samples.
struct SamplingError {
    std::string scene;
    double ours = 0, independent = 0;
};

struct RenderFigures {
    std::vector<RayRates> rates;
    std::vector<SamplingError> errors;
};

/// `quick`: small, only checks that it runs. Empty if the path tracer is not built.
[[nodiscard]] RenderFigures measureRender(bool quick);

}  // namespace mfar::bench
