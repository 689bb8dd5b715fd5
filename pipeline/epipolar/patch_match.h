#pragma once

#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Side of a patch [px].
inline constexpr int kPatch = 8;

/// First column and row of a patch of kPatch x kPatch pixels, at least one pixel inside its
/// picture.
struct PatchPlace {
    int x = 0, y = 0;
    /// Its middle [px].
    [[nodiscard]] Eigen::Vector2d middle() const {
        return {x + 0.5 * (kPatch - 1), y + 0.5 * (kPatch - 1)};
    }
};

/// The place with the most texture in each of 300 to 700 equal cells of the picture (fewer in a
/// small picture): where the smaller eigenvalue of the structure tensor is largest. A cell has no
/// place if that eigenvalue could be due to noise alone. `noise`: standard deviation of a pixel
/// [grey levels]. Source: Shi and Tomasi, CVPR 1994.
[[nodiscard]] std::vector<PatchPlace> texturedPlaces(const LumaImage& picture, double noise);

/// Where to look for a patch: this number of one-pixel steps from `middle` to either side.
struct PatchWindow {
    Eigen::Vector2d middle;  ///< where the patch's middle is expected [px]
    Eigen::Vector2d along;   ///< unit vector
    int alongSteps = 0, acrossSteps = 0;
};

/// Finds patches of one picture in another, independent of the gain and offset of either. Borrows
/// both.
class PatchMatcher {
public:
    /// `seen`: one byte per pixel, 1 where `to` is valid.
    PatchMatcher(const LumaImage& from, const LumaImage& to, const std::vector<std::uint8_t>& seen)
        : from_(from), to_(to), seen_(seen) {}

    /// The middle of the best place by zero-mean normalised correlation, to one pixel. Empty when
    /// no place fits well, or when two places that lie apart fit equally well.
    [[nodiscard]] std::optional<Eigen::Vector2d> find(PatchPlace place,
                                                      const PatchWindow& window) const;

    /// Refines `near` to sub-pixels by inverse-compositional steps; empty when they lead too far
    /// away. Source: Baker and Matthews, IJCV 2004.
    [[nodiscard]] std::optional<Eigen::Vector2d> polish(PatchPlace place,
                                                        const Eigen::Vector2d& near) const;

private:
    [[nodiscard]] bool shows(int x, int y) const;

    const LumaImage& from_;
    const LumaImage& to_;
    const std::vector<std::uint8_t>& seen_;
};

}  // namespace mfar
