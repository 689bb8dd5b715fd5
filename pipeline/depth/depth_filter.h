#pragma once

#include "base/workers.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/flow/luma_image.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mfar {

/// Estimates the scene's inverse depth over time. Every pixel has a Kalman filter with the state
/// (inverse depth, variance). When the camera moves, each state moves to the pixel that shows the
/// same point. The scene is assumed to be static. Source: Engel et al., Semi-dense visual odometry,
/// ICCV 2013 (filter in inverse depth); Vogiatzis and Hernandez, Video-based real-time multi-view
/// stereo, 2011 (outliers).
class DepthFilter {
public:
    DepthFilter(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthFilter(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// Uses `lens` instead of a new EpipolarLens. `lens` must contain the rays of all pixels of
    /// `video`.
    DepthFilter(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    void forget();
    /// Moves the known depths to a camera at this pose. `seconds` is the time since the last call.
    /// If several points move to one pixel, the nearest is kept (z-test). The variance grows with
    /// the duration of the motion. Small motions of the camera are summed, and the depths move only
    /// when the sum is visible. So a camera at rest loses no depth. An invalid pose (see
    /// soundMotion()) discards all depths.
    void predict(const RigidTransform& T_world_video, double seconds);
    /// Fuses the depth of a frame, measured within `where` at the pose of the last predict(). If a
    /// measurement agrees with the known depth of its pixel, the two are averaged. If two
    /// consecutive measurements of a pixel disagree with its known depth, the second of them
    /// replaces it. Pixels of `measured` without a valid inverse depth and variance are ignored,
    /// and so are pixels whose flag in `fixed` is not 0. `fixed` is empty or has a flag for each
    /// pixel of the picture.
    void fuse(const InverseDepthField& measured, const PixelRect& where,
              std::span<const std::uint8_t> fixed = {});
    void forget(const PixelRect& where);
    /// Deletes the known depths that `measured` contradicts inside `where`, but only in blocks in
    /// which most measurements contradict the known depth. Thus, a few false measurements among
    /// many correct ones delete nothing.
    void forgetContradicted(const InverseDepthField& measured, const PixelRect& where);

    [[nodiscard]] const InverseDepthField& field() const { return field_; }
    /// A rectangle that contains all pixels with known depth. It may be too large.
    [[nodiscard]] const PixelRect& known() const { return known_; }

private:
    /// Data of each pixel: the position of its scene point relative to the pixel's centre [px], and
    /// the number of consecutive measurements that disagreed with the known depth.
    struct Points {
        std::vector<float> x, y;
        std::vector<std::uint8_t> outliers;

        explicit Points(std::size_t pixels) : x(pixels), y(pixels), outliers(pixels) {}
        void reset(std::size_t pixel) {
            x[pixel] = y[pixel] = 0;
            outliers[pixel] = 0;
        }
    };
    [[nodiscard]] bool moves(const RigidTransform& T_now_before) const;
    void carry(const RigidTransform& T_now_before, float growth);
    void takeLanded(int firstRow, int lastRow);
    void closeCracks();
    void closeCrack(std::size_t i, std::size_t before, std::size_t after);
    void fusePixel(std::size_t i, float inverseDepth, float variance);
    [[nodiscard]] bool agrees(std::size_t i, float inverseDepth, float variance) const;
    void forgetContradictedBlock(const InverseDepthField& measured, const PixelRect& block);

    EpipolarLens lens_;
    float focal_, pixelX_, pixelY_;
    std::shared_ptr<Workers> workers_;
    std::optional<RigidTransform> fieldPose_;
    // Time since the points were last moved, but at most kMostMoving [s].
    double moving_ = 0;
    // field_: the current depths. carried_: memory into which the points are moved. Before and
    // after a move, all depths in carried_ are unknown.
    InverseDepthField field_, carried_;
    PixelRect known_;
    Points points_, carriedPoints_;
    /// Result of moving the points of the pixels in known_ to a new camera pose. `bounds` has one
    /// entry for each row of pixels: the bounding box of the pixels to which the points of this row
    /// move.
    struct Moved {
        std::vector<std::int32_t> pixel;
        std::vector<float> x, y, inverseDepth, variance;
        std::vector<PixelRect> bounds;
    };
    Moved moved_;
};

}  // namespace mfar
