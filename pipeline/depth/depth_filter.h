#pragma once

#include "base/workers.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/flow/luma_image.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mfar {

/// Estimates the scene's inverse depth over time. Every pixel has a Kalman filter with the state
/// (inverse depth, variance). When the camera moves, the states move to the pixels that show the
/// same points. Where depth is known, the scene is assumed to be static. Source: Engel et al.,
/// Semi-dense visual odometry, ICCV 2013 (filter in inverse depth); Vogiatzis and Hernandez,
/// Video-based real-time multi-view stereo, 2011 (outliers).
class DepthFilter {
public:
    DepthFilter(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthFilter(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// Uses `lens` (with the rays of all its pixels) instead of computing an EpipolarLens from
    /// `video`.
    DepthFilter(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Discards all depths.
    void forget();
    /// Moves the known depths to a camera at this pose, `seconds` after the last call. Where
    /// several surfaces land on a pixel, the nearest is kept (z-test). The variance grows with the
    /// duration of the motion. Camera motions too small to be visible are summed up first, so that
    /// a camera at rest loses no depth. An invalid pose (soundMotion()) discards all depths,
    /// because no motion to or from it is known.
    void predict(const RigidTransform& T_world_video, double seconds);
    /// Fuses the depth measured in a frame at the pose of the last predict(), within `where`. A
    /// measurement that agrees with the known depth of its pixel is averaged with it; measurements
    /// that repeatedly disagree replace it. Pixels of `measured` without a valid inverse depth and
    /// variance are ignored.
    void fuse(const InverseDepthField& measured, const PixelRect& where);
    /// Discards the depths of these pixels, because something moves there.
    void forget(const PixelRect& where);

    [[nodiscard]] const InverseDepthField& field() const { return field_; }
    /// Bounds of all pixels with known depth.
    [[nodiscard]] const PixelRect& known() const { return known_; }

private:
    /// For each pixel: the offset of its scene point from the pixel's centre [px], and the number
    /// of consecutive measurements that disagreed with the known depth.
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
    /// Stores the moved points that land in these rows of the picture. If several land on a pixel,
    /// the nearest is kept.
    void takeLanded(int firstRow, int lastRow);
    void closeCracks();
    void closeCrack(std::size_t i, std::size_t before, std::size_t after);
    void fusePixel(std::size_t i, float inverseDepth, float variance);

    EpipolarLens lens_;
    float focal_, pixelX_, pixelY_;  // focal_: focal length [px]; pixelX_, pixelY_: size of a pixel
                                     // at z = 1
    std::shared_ptr<Workers> workers_;
    std::optional<RigidTransform> fieldPose_;
    double moving_ = 0;                  // duration of the camera's motion since the points were
                                         // last moved [s]
    InverseDepthField field_, carried_;  // carried_: target while points are moved; otherwise all
                                         // of it is unknown
    PixelRect known_;
    Points points_, carriedPoints_;
    /// The points of the pixels in known_ after a motion of the camera.
    struct Moved {
        std::vector<std::int32_t> pixel;
        std::vector<float> x, y, inverseDepth, variance;
        std::vector<PixelRect> bounds;  // for each row of points: bounds of the pixels that its
                                        // points move to
    };
    Moved moved_;
};

}  // namespace mfar
