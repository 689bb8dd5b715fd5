#pragma once

#include <string>
#include <vector>

namespace mfar::bench {

/// First hits of a 640x480 camera on a sphere, one thread, the same rays: Embree's rtcIntersect1
/// in a bare loop, our camera rays with lens and packets, and whole samples in matt sunlight.
struct RayRates {
    int triangles = 0;
    double bare = 0, ours = 0;  ///< [Mray/s]
    double samples = 0;         ///< [Msample/s], of the whole picture
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

/// `quick`: small, shows that it runs. Empty where the path tracer is not built.
[[nodiscard]] RenderFigures measureRender(bool quick);

}  // namespace mfar::bench
