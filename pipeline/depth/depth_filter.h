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

/// The scene's inverse depth over time: for every pixel a Kalman filter in (rho, variance), carried
/// from frame to frame by the camera's motion. Assumes a static scene where depth is known. Source:
/// Engel et al., Semi-dense visual odometry, ICCV 2013 (filter in inverse depth); Vogiatzis and
/// Hernandez, Video-based real-time multi-view stereo, 2011 (outliers).
class DepthFilter {
public:
    DepthFilter(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthFilter(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// As above, sharing the camera's rays.
    DepthFilter(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Discards all depths.
    void forget();
    /// Carries the known depths to a camera at this pose; where several surfaces meet, the nearest
    /// is kept (z-test). The variance grows with the duration of the motion. Camera motions too
    /// small to be visible are summed up first; a camera at rest forgets nothing. An invalid pose
    /// (soundMotion()) discards all depths, because nothing can be carried from there.
    void predict(const RigidTransform& T_world_video, double seconds);
    /// Fuses the measurement of a frame at the pose of the last predict(), within `where`. A
    /// measurement that agrees with the known depth is fused; one that repeatedly disagrees
    /// replaces it. Pixels without a valid inverse depth and variance are ignored.
    void fuse(const InverseDepthField& measured, const PixelRect& where);
    /// Discards the depths of these pixels, where something moves.
    void forget(const PixelRect& where);

    [[nodiscard]] const InverseDepthField& field() const { return field_; }
    /// Bounds of all pixels with known depth.
    [[nodiscard]] const PixelRect& known() const { return known_; }

private:
    /// Per pixel: the place of its point relative to the pixel's middle [px], and the number of
    /// consecutive measurements that disagreed with it.
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
    /// Takes the points that land in these rows of the picture; where several meet, the nearest.
    void takeLanded(int firstRow, int lastRow);
    void closeCracks();
    void closeCrack(std::size_t i, std::size_t before, std::size_t after);
    void fusePixel(std::size_t i, float rho, float variance);

    EpipolarLens lens_;
    float focal_, pixelX_, pixelY_;  // [px], and size of a pixel [rays]
    std::shared_ptr<Workers> workers_;
    std::optional<RigidTransform> fieldPose_;
    double moving_ = 0;                  // time of motion since the field was last carried [s]
    InverseDepthField field_, carried_;  // all pixels of carried_ are unknown between two motions
    PixelRect known_;
    Points points_, carriedPoints_;
    /// Where a motion moves the points of known_.
    struct Moved {
        std::vector<std::int32_t> pixel;
        std::vector<float> x, y, rho, variance;
        std::vector<PixelRect> bounds;  // of the pixels where each row lands
    };
    Moved moved_;
};

}  // namespace mfar
