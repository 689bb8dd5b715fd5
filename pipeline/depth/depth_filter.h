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

/// The scene's inverse depth over time: a Kalman filter in (rho, variance) for every pixel, which
/// the camera's motion carries from frame to frame. The scene is static where it is known. Source:
/// Engel et al., Semi-dense visual odometry, ICCV 2013 (filter in inverse depth); Vogiatzis and
/// Hernandez, Video-based real-time multi-view stereo, 2011 (outliers).
class DepthFilter {
public:
    DepthFilter(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthFilter(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// The same with the camera's rays, which others have already.
    DepthFilter(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Nothing is known any more.
    void forget();
    /// Carries what is known to a camera at this pose, the nearest where several surfaces meet
    /// (z-test); its variance grows with the time that this motion took. Camera motions too small
    /// to show are added up first; a camera at rest forgets nothing. A pose that is none
    /// (soundMotion()) forgets everything: from there nothing can be carried.
    void predict(const RigidTransform& T_world_video, double seconds);
    /// Takes the measurement of a frame at the pose of the last predict(), within `where`: fused
    /// where it agrees with what is known, and instead of that where it keeps disagreeing. What is
    /// no inverse depth with a variance says nothing.
    void fuse(const InverseDepthField& measured, const PixelRect& where);
    /// Something moves in these pixels.
    void forget(const PixelRect& where);

    [[nodiscard]] const InverseDepthField& field() const { return field_; }
    /// Holds every pixel of which something is known.
    [[nodiscard]] const PixelRect& known() const { return known_; }

private:
    /// Of pixels: where in each its point lies, from the middle [px], and how many measurements in
    /// a row disagreed with it.
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
    /// Points that land in these rows of the picture, the nearest where several meet.
    void takeLanded(int firstRow, int lastRow);
    void closeCracks();
    void closeCrack(std::size_t i, std::size_t before, std::size_t after);
    void fusePixel(std::size_t i, float rho, float variance);

    EpipolarLens lens_;
    float focal_, pixelX_, pixelY_;  // [px], and rays a pixel
    std::shared_ptr<Workers> workers_;
    std::optional<RigidTransform> fieldPose_;
    double moving_ = 0;                  // since the field was last carried [s]
    InverseDepthField field_, carried_;  // nothing is known in carried_ between two motions
    PixelRect known_;
    Points points_, carriedPoints_;
    /// Where the points of known_ go in a motion.
    struct Moved {
        std::vector<std::int32_t> pixel;
        std::vector<float> x, y, rho, variance;
        std::vector<PixelRect> bounds;  // of what each row lands on
    };
    Moved moved_;
};

}  // namespace mfar
