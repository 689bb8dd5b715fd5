#pragma once

#include "pipeline/depth/depth_filter.h"
#include "pipeline/depth/depth_measurement.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/depth/keyframes.h"
#include "pipeline/epipolar/unit_pose.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Measures the depth of the real scene and filters it over time. Depth from the match with the
/// still costs little, because each frame is matched with the still anyway. A match with an earlier
/// frame (keyframe) is added where it promises more accuracy. Runs on the CPU, without GL.
class DepthStage {
public:
    DepthStage(const CameraModel& video, std::shared_ptr<Workers> workers,
               const DepthOptions& options = {});

    /// Results of the epipolar search that matched this frame with the still. `R_still_video` is
    /// EpipolarFlow::rotation(). The search's unit of length is `unit` metres, and `lengthError` is
    /// the relative error of `unit`. For `cells`, see DepthMeasurement::run().
    struct StillSearch {
        const EpipolarSearch& search;
        const Eigen::Matrix3f& R_still_video;
        double unit;
        double lengthError;
        std::span<const float> cells;
    };

    void forget();
    /// Must be called when the still changes. Without this call, depth would be measured with the
    /// new still only after the next motion of the camera. While the camera rests, depth is
    /// measured only once with each still, so this measurement must correct wrong depths at once:
    /// in blocks of pixels where it contradicts most known depths, it replaces the contradicted
    /// ones.
    void renew() { isRenewed_ = true; }
    /// Moves the known depth to the pose of this frame and measures depth inside `where`, which may
    /// be empty. `still` is empty if the frame was not matched along epipolar lines.
    void run(const Rows<const std::uint8_t>& luma, const Pose& pose,
             const std::optional<StillSearch>& still, const PixelRect& where);
    /// Forgets the known depth inside `where`. It is measured again even if the camera rests.
    void forget(const PixelRect& where);

    [[nodiscard]] const InverseDepthField& field() const { return filter_.field(); }
    [[nodiscard]] DepthSource source() const { return source_; }

private:
    struct Summary {
        double inverseDepth = 0;
        /// Median of the relative standard deviations of inverse depth, at most 1; 1 if no depth is
        /// known.
        double share = 1;
    };
    struct Need {
        PixelRect part;
        double share;
        Keyframes::Choice choice;
    };
    [[nodiscard]] Summary summaryOf(const PixelRect& where, const Pose& pose);
    [[nodiscard]] bool hasMoved(const Pose& pose, double inverseDepth) const;
    [[nodiscard]] bool isMeasured(const PixelRect& where) const;
    void fixKnown(const PixelRect& where);
    void findNeeds(const Pose& pose, double brightness, double stillBaseline,
                   const PixelRect& where);
    void searchKeyframe(const Rows<const std::uint8_t>& luma, const Pose& pose);
    [[nodiscard]] std::span<const float> predicted(const UnitPose& relative,
                                                   const PixelRect& where);

    DepthOptions options_;
    double focal_;
    Keyframes keyframes_;
    EpipolarSearch search_;
    DepthMeasurement measurement_;
    DepthFilter filter_;
    InverseDepthField measured_;
    DepthSource source_ = DepthSource::None;
    long searchedKey_ = -1;
    std::optional<RigidTransform> measuredPose_;
    // isRenewed_: the still changed after the last measurement. isLost_: after the last
    // measurement, forget(where) deleted depths of the measured rectangle.
    bool isRenewed_ = false, isLost_ = false;
    PixelRect measuredWhere_;
    // Empty, or for each pixel: 1 if the current frame must not change the pixel's depth, else 0.
    std::vector<std::uint8_t> fixed_;
    std::optional<Timestamp> last_;
    int world_ = 0;  ///< world frame of the known depth and of the keyframes, see Pose::world
    std::vector<Need> needs_;
    std::vector<float> predicted_, samples_, shares_;
};

}  // namespace mfar
