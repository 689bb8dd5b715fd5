#pragma once

#include "pipeline/depth/depth_filter.h"
#include "pipeline/depth/depth_measurement.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/depth/keyframes.h"
#include "pipeline/epipolar/unit_pose.h"

#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// The depth of the real scene, measured against the still (for nothing: its flow is known),
/// against a keyframe where that promises more, and filtered over time. Runs on the host's
/// processor; no GL.
class DepthStage {
public:
    DepthStage(const CameraModel& video, std::shared_ptr<Workers> workers,
               const DepthOptions& options = {});

    /// A search of this frame against the still.
    struct StillSearch {
        const EpipolarSearch& search;
        const Eigen::Matrix3f& R_still_video;  ///< of rays, at the video's geometry
        double unit;                           ///< [m]
        double lengthError;                    ///< of it, UnitPose
        std::span<const float> cells;          ///< see DepthMeasurement::run()
    };

    void forget();
    /// What is there to measure against has changed: another still.
    void renew() { measuredPose_.reset(); }
    /// A frame that changed. Measures inside of `where`, which may be empty.
    void run(const Rows<const std::uint8_t>& luma, const Pose& pose,
             const std::optional<StillSearch>& still, const PixelRect& where);
    /// Something moves in these pixels: nothing is known of them.
    void forget(const PixelRect& where) { filter_.forget(where); }

    [[nodiscard]] const InverseDepthField& field() const { return filter_.field(); }
    [[nodiscard]] DepthSource source() const { return source_; }

private:
    struct Summary {
        double rho = 0;    ///< median of what is known [1/m]
        double share = 1;  ///< median of its standard deviation, as a share of it
    };
    /// A part of the picture that knows too little, and the keyframe that would help it.
    struct Need {
        PixelRect part;
        double share;
        Keyframes::Choice choice;
    };
    [[nodiscard]] Summary summaryOf(const PixelRect& where, const Pose& pose);
    [[nodiscard]] bool seesMore(const Pose& pose, double rho, const PixelRect& where) const;
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
    PixelRect measuredWhere_;
    std::optional<Timestamp> last_;
    std::vector<Need> needs_;
    std::vector<float> predicted_, samples_, shares_;
};

}  // namespace mfar
