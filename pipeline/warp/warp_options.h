#pragma once

namespace mfar {

/// What to do with pixels of a model that no picture shows. Cracks one pixel wide are always
/// closed.
enum class HoleFilling {
    None,      ///< they remain empty
    PushPull,  ///< filled from their surroundings
    Rerender,  ///< rendered individually, empty until then
    Both,      ///< rendered individually, filled from their surroundings until then
};

struct WarpOptions {
    HoleFilling filling = HoleFilling::Both;
    /// Upper limit of the pixels in one request, at least 1: 5 % of 640x480.
    int mostRequested = 15360;
    int holeSamples = 4;  ///< per pixel, [1, 4096]
    /// Share of the objects' pixels that is rendered individually while the camera rests: those at
    /// edges, which the warp blurs; [0, 1], 0: none.
    double sharpenShare = 0.4;
    int sharpenSamples = 40;  ///< per pixel, [1, 4096]
    /// Number of frames over which rendered pixels fade in, [0, 100].
    int fadeFrames = 4;
    /// The reference is shown unchanged when the pose moves all of its points by less than this
    /// [px], [0, 10].
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

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const WarpOptions& options);

}  // namespace mfar
