#pragma once

#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Width and height of a patch [px].
inline constexpr int kPatch = 8;

/// Position of a patch of kPatch x kPatch pixels: its first column and row. The patch is at least
/// one pixel away from the border of its picture.
struct PatchPlace {
    int x = 0, y = 0;
    /// The patch's middle [px].
    [[nodiscard]] Eigen::Vector2d middle() const {
        return {x + 0.5 * (kPatch - 1), y + 0.5 * (kPatch - 1)};
    }
};

/// Divides the picture into 300 to 700 equal cells (fewer if the picture is small) and returns the
/// patch with the most texture in each cell: the one whose structure tensor has the largest smaller
/// eigenvalue. Cells in which noise alone could cause this eigenvalue are skipped. `noise`:
/// standard deviation of the noise of a pixel [grey levels]. Source: Shi and Tomasi, CVPR 1994.
[[nodiscard]] std::vector<PatchPlace> texturedPlaces(const LumaImage& picture, double noise);

/// Positions where a patch is searched: `middle`, and alongSteps and acrossSteps steps of one pixel
/// to either side of it, along the epipolar line and across it.
struct PatchWindow {
    Eigen::Vector2d middle;  ///< expected position of the patch's middle [px]
    Eigen::Vector2d along;   ///< direction of the epipolar line, unit vector
    int alongSteps = 0, acrossSteps = 0;
};

/// Finds patches of one picture in another; the gains and offsets of the pictures may differ.
/// Refers to both pictures, which must outlive this object.
class PatchMatcher {
public:
    /// `seen`: one byte per pixel of `to`, 1 where the pixel is valid.
    PatchMatcher(const LumaImage& from, const LumaImage& to, const std::vector<std::uint8_t>& seen)
        : from_(from), to_(to), seen_(seen) {}

    /// Returns the middle of the patch in the other picture that has the highest zero-mean
    /// normalised correlation, in whole pixels. Empty if no patch fits well, or if two patches far
    /// from each other fit about equally well.
    [[nodiscard]] std::optional<Eigen::Vector2d> find(PatchPlace place,
                                                      const PatchWindow& window) const;

    /// Refines the match `near` to a fraction of a pixel by inverse-compositional steps. Empty if
    /// they lead too far away from it. Source: Baker and Matthews, IJCV 2004.
    [[nodiscard]] std::optional<Eigen::Vector2d> polish(PatchPlace place,
                                                        const Eigen::Vector2d& near) const;

private:
    [[nodiscard]] bool shows(int x, int y) const;

    const LumaImage& from_;
    const LumaImage& to_;
    const std::vector<std::uint8_t>& seen_;
};

}  // namespace mfar
