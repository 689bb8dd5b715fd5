#pragma once

#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

inline constexpr int kPatch = 8;

/// First column and first row of a patch. Around the patch, its picture must have at least one more
/// pixel on each side.
struct PatchPlace {
    int x = 0, y = 0;
    [[nodiscard]] Eigen::Vector2d middle() const {
        return {x + 0.5 * (kPatch - 1), y + 0.5 * (kPatch - 1)};
    }
};

/// Divides the picture into 300 to 700 equal parts (fewer if the picture is small), and returns the
/// patch of each part with the most texture. Texture is the smaller eigenvalue of the patch's
/// structure tensor. A part is skipped if noise alone could cause this texture. `noise` is the
/// standard deviation of a pixel's noise [grey levels]. Source: Shi and Tomasi, CVPR 1994.
[[nodiscard]] std::vector<PatchPlace> texturedPlaces(const LumaImage& picture, double noise);

/// Positions at which a patch is searched. They are at most alongSteps pixels from `middle` along
/// the epipolar line, and at most acrossSteps pixels perpendicular to it, in both directions.
struct PatchWindow {
    Eigen::Vector2d middle;
    Eigen::Vector2d along;
    int alongSteps = 0, acrossSteps = 0;
};

/// Finds patches of one picture in another. Gain and offset of the pictures may differ. Both
/// pictures must outlive this object.
class PatchMatcher {
public:
    /// `seen` has one byte per pixel of `to`: 1 for valid pixels, else 0.
    PatchMatcher(const LumaImage& from, const LumaImage& to, const std::vector<std::uint8_t>& seen)
        : from_(from), to_(to), seen_(seen) {}

    /// Returns the middle of the patch of `to` in `window` that has the highest zero-mean
    /// normalised correlation. The result is accurate to whole pixels. It is empty if no patch fits
    /// well, or if a distant patch fits about equally well.
    [[nodiscard]] std::optional<Eigen::Vector2d> find(PatchPlace place,
                                                      const PatchWindow& window) const;

    /// Refines the match `near` to a fraction of a pixel by inverse-compositional steps. The result
    /// is empty if the steps lead too far away from `near`, to invalid pixels, or to a patch that
    /// is uniform. Source: Baker and Matthews, IJCV 2004.
    [[nodiscard]] std::optional<Eigen::Vector2d> polish(PatchPlace place,
                                                        const Eigen::Vector2d& near) const;

private:
    [[nodiscard]] bool shows(int x, int y) const;

    const LumaImage& from_;
    const LumaImage& to_;
    const std::vector<std::uint8_t>& seen_;
};

}  // namespace mfar
