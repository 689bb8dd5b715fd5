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
    /// The patch's middle [px].
    [[nodiscard]] Eigen::Vector2d middle() const {
        return {x + 0.5 * (kPatch - 1), y + 0.5 * (kPatch - 1)};
    }
};

/// Divides the picture into 300 to 700 equal cells (fewer if the picture is small) and returns the
/// place with the most texture in each: the smaller eigenvalue of the structure tensor is largest
/// there. Cells in which noise alone could cause this eigenvalue are skipped. `noise`: standard
/// deviation of a pixel [grey levels]. Source: Shi and Tomasi, CVPR 1994.
[[nodiscard]] std::vector<PatchPlace> texturedPlaces(const LumaImage& picture, double noise);

/// Positions where a patch is searched: `middle`, and this number of one-pixel steps to either side
/// of it, along the line and across it.
struct PatchWindow {
    Eigen::Vector2d middle;  ///< expected place of the patch's middle [px]
    Eigen::Vector2d along;   ///< direction of the line, unit vector
    int alongSteps = 0, acrossSteps = 0;
};

/// Finds patches of one picture in another, whatever the gain and offset of each. Refers to both
/// pictures, which must outlive this object.
class PatchMatcher {
public:
    /// `seen`: one byte per pixel of `to`, 1 where the pixel is valid.
    PatchMatcher(const LumaImage& from, const LumaImage& to, const std::vector<std::uint8_t>& seen)
        : from_(from), to_(to), seen_(seen) {}

    /// Returns the middle of the place with the highest zero-mean normalised correlation, to one
    /// pixel. Empty if no place fits well, or if two distant places fit equally well.
    [[nodiscard]] std::optional<Eigen::Vector2d> find(PatchPlace place,
                                                      const PatchWindow& window) const;

    /// Refines `near` to a fraction of a pixel by inverse-compositional steps. Empty if they lead
    /// too far away. Source: Baker and Matthews, IJCV 2004.
    [[nodiscard]] std::optional<Eigen::Vector2d> polish(PatchPlace place,
                                                        const Eigen::Vector2d& near) const;

private:
    [[nodiscard]] bool shows(int x, int y) const;

    const LumaImage& from_;
    const LumaImage& to_;
    const std::vector<std::uint8_t>& seen_;
};

}  // namespace mfar
