#pragma once

namespace mfar {

/// How to fill pixels of a model that no picture shows. Cracks that are one pixel wide are always
/// closed.
enum class HoleFilling {
    None,      ///< the pixels remain empty
    PushPull,  ///< the pixels are interpolated from their surroundings
    Rerender,  ///< the pixels are rendered individually and stay empty until then
    Both,      ///< the pixels are rendered individually and interpolated until then
};

struct WarpOptions {
    HoleFilling filling = HoleFilling::Both;
    /// Upper limit of the number of pixels in one request, at least 1. The default is 5 % of
    /// 640x480.
    int mostRequested = 15360;
    int holeSamples = 4;  ///< samples per pixel of a hole, [1, 4096]
    /// While the camera rests, pixels at edges are rendered individually, because the warp blurs
    /// edges. This is the largest number of these pixels, as a share of the objects' pixels. Range
    /// [0, 1]; 0: no pixels.
    double sharpenShare = 0.4;
    int sharpenSamples = 40;  ///< samples per pixel at an edge, [1, 4096]
    /// Number of frames in which individually rendered pixels fade in, [0, 100]. Used only with
    /// HoleFilling::Both.
    int fadeFrames = 4;
    /// The traced picture is shown unchanged if the new pose moves all of its points by less
    /// than this distance [px], [0, 10].
    double leastMotion = 0.1;
    bool operator==(const WarpOptions&) const = default;
};

/// Whether pixels are rendered individually.
[[nodiscard]] inline bool rerenders(HoleFilling filling) {
    return filling == HoleFilling::Rerender || filling == HoleFilling::Both;
}
/// Whether holes are filled from their surroundings.
[[nodiscard]] inline bool pushPulls(HoleFilling filling) {
    return filling == HoleFilling::PushPull || filling == HoleFilling::Both;
}

/// Throws std::invalid_argument whose message names the first option that is out of range.
void validate(const WarpOptions& options);

}  // namespace mfar
