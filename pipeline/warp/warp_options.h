#pragma once

namespace mfar {

/// Method to fill pixels of a model that no picture shows (holes). Holes at edges and cracks of one
/// pixel are always interpolated. Holes in the shadow catcher are never rendered, because a shadow
/// is smooth and a few samples of it would be noisy. They stay empty with None and are interpolated
/// with every other method.
enum class HoleFilling {
    None,      ///< leave the pixels empty
    PushPull,  ///< interpolate the pixels from their surroundings
    Rerender,  ///< render the pixels individually; they stay empty until then
    Both,      ///< render the pixels individually; they are interpolated until then
};

struct WarpOptions {
    HoleFilling filling = HoleFilling::Both;
    /// Upper limit of the pixels in one request, at least 1. The default is 5 % of 640x480.
    int mostRequested = 15360;
    int holeSamples = 4;  ///< samples per pixel, [1, 256]
    /// The warp blurs edges. While the camera rests, edge pixels are rendered individually and
    /// replace the warped ones. This is the upper limit of their number, as a share of the objects'
    /// pixels, [0, 1]. If it is 0 or rerenders(filling) is false, no edge pixels are
    /// rendered.
    double sharpenShare = 0.4;
    int sharpenSamples = 40;  ///< samples per edge pixel, [1, 256]
    /// Number of frames over which rendered pixels fade in, [0, 100]. Used only with
    /// HoleFilling::Both.
    int fadeFrames = 4;
    /// If a new pose moves all points by less than this distance [px], [0, 10], the traced picture
    /// is shown unchanged, unless it is layered (RenderedPicture::layered) or objects can move.
    double leastMotion = 0.1;
    bool operator==(const WarpOptions&) const = default;
};

[[nodiscard]] inline bool rerenders(HoleFilling filling) {
    return filling == HoleFilling::Rerender || filling == HoleFilling::Both;
}
[[nodiscard]] inline bool pushPulls(HoleFilling filling) {
    return filling == HoleFilling::PushPull || filling == HoleFilling::Both;
}
[[nodiscard]] inline bool fillsShadows(HoleFilling filling) {
    return filling != HoleFilling::None;
}

/// Throws std::invalid_argument that names the first option out of range.
void validate(const WarpOptions& options);

}  // namespace mfar
