#include "daemon/tools/calibrate/solve.h"

#include "daemon/tools/calibrate/rig_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

namespace mfar::calibration {
namespace {

constexpr int kLeastVideoViews = 12, kLeastStillViews = 6, kLeastPairs = 5;
// A still is usable if no video frame is missing between the four frames around it. If fewer stills
// than this are usable, single missing frames are accepted.
constexpr int kFewPairs = 12;
// A clock offset counts as known if its standard deviation is at most this [s].
constexpr double kMaxOffsetDeviation = 0.002;
// The target counts as moving during a still if its image in the video moves by at least this
// distance [px] over the three frame intervals around the still.
constexpr double kLeastMotion = 1;
constexpr int kLeastMoving = 3;  // stills; if the target moves in fewer, the offset stays 0
constexpr double kMaxFocalDeviation = 0.005;     // as a share of the focal length
constexpr double kMaxBaselineDeviation = 0.002;  // [m]
// The cameras disagree if the RMS residual of one of them, fitted together with the other, exceeds
// both kMostResidual [px] and kMostGrowth times its residual when it is fitted alone.
constexpr double kMostResidual = 1, kMostGrowth = 4;

struct Member {
    int view = 0;
    int index = 0;
};

struct Guesses {
    CameraModel video, still;
};

class Assembly {
public:
    Assembly(const Target& target, const SensorViews& video, const SensorViews& still,
             const Guesses& guesses, const SolveOptions& options)
        : target_(target), video_(video), still_(still), options_(options),
          videoFit_(fitCamera(target, video_.views, guesses.video, "video", options.videoViews)),
          stillFit_(fitCamera(target, still_.views, guesses.still, "still", options.stillViews)) {
        for (int i = 0; i < static_cast<int>(video_.views.size()); ++i) {
            if (!videoFit_.poses[i]) continue;
            track_.add(video_.views[i].time, *videoFit_.poses[i]);
            trackViews_.push_back(i);
        }
        const auto isTied = [&](const TargetView& view) {
            return track_.around(view.time).has_value();
        };
        if (std::ranges::count_if(still_.views, isTied) < kFewPairs) track_.allowMissingFrames();
        if (movingStills() < kLeastMoving) options_.maxOffset = 0;
        std::vector<StillPose> stills;
        for (std::size_t i = 0; i < still_.views.size(); ++i)
            if (stillFit_.poses[i]) stills.push_back({still_.views[i].time, *stillFit_.poses[i]});
        start_ = startOfRig(track_, stills, options_.maxOffset);
        requirePairs(start_.stills);
    }

    Calibration run() {
        Calibration out;
        std::optional<RigBundle> bundle = adjusted(start_.offset, true, out);
        if (!out.offsetKnown) bundle = adjusted(0, false, out);
        if (leaveOut(*bundle)) bundle = adjusted(bundle->offset(), out.offsetKnown, out);
        if (!out.offsetKnown && bundle->offset() != 0) bundle = adjusted(0, false, out);
        out.rig = {bundle->rig(), bundle->offset()};
        out.extrinsicDeviations = bundle->deviations().segment<6>(kExtrinsicAt);
        out.offsetDeviation = bundle->deviations()[kOffsetAt];
        out.pairs = pairs_;
        out.video = result(*bundle, video_, videoFit_, videoMembers_, false);
        out.still = result(*bundle, still_, stillFit_, stillMembers_, true);
        checkAgreement(out);
        return out;
    }

private:
    static void requirePairs(int stills) {
        if (stills < kLeastPairs)
            throw Unsuitable(fmt::format(
                "only {} stills were taken while the video saw the target and lost no frames; at "
                "least {} are needed",
                stills, kLeastPairs));
    }

    /// Returns the number of stills during which the target moves in the video by more than noise.
    /// If the camera is at rest, noise looks like motion. The clock offset would then be wrong,
    /// although its standard deviation is small.
    [[nodiscard]] int movingStills() const {
        const CameraModel& camera = videoFit_.camera;
        const auto seen = [&](const RigidTransform& T, const Eigen::Vector3d& point) {
            const Eigen::Vector3d p = T * point;
            return Eigen::Vector2d(camera.fx * p.x() / p.z(), camera.fy * p.y() / p.z());
        };
        int out = 0;
        for (const TargetView& still : still_.views) {
            const auto nodes = track_.around(still.time);
            if (!nodes || still.corners.empty()) continue;
            double sum = 0;
            for (const Corner& c : still.corners)
                sum += (seen(track_.pose((*nodes)[3]), target_.points[c.index]) -
                        seen(track_.pose((*nodes)[0]), target_.points[c.index]))
                           .norm();
            out += sum / static_cast<double>(still.corners.size()) >= kLeastMotion ? 1 : 0;
        }
        return out;
    }

    /// If the clock offset is wrong, the bundle finds poses that fit both cameras only roughly.
    /// Then the residuals are much larger than with each camera alone.
    void checkAgreement(const Calibration& out) const {
        if (std::abs(out.rig.stillTimeOffset) > options_.maxOffset)
            throw Unsuitable(fmt::format("the clock offset {:.3f} s that fits best lies outside "
                                         "--max-offset ({:g} s): try a larger limit",
                                         out.rig.stillTimeOffset, options_.maxOffset));
        for (const auto& [name, found, sigma] :
             {std::tuple("video", out.video.rms, videoFit_.sigma),
              std::tuple("still", out.still.rms, stillFit_.sigma)}) {
            const double alone = std::numbers::sqrt2 * sigma;
            if (!(found <= std::max(kMostResidual, kMostGrowth * alone)))
                throw Unsuitable(fmt::format(
                    "the two sensors disagree: the residual of the {} sensor is {:.2f} px alone "
                    "and {:.2f} px together with the other sensor. The times of the stills may be "
                    "wrong by more than --max-offset",
                    name, alone, found));
        }
    }

    int poseOf(RigBundle& bundle, int videoView) {
        const auto [at, isNew] = videoPoses_.try_emplace(videoView, 0);
        if (isNew) {
            at->second = bundle.addPose(*videoFit_.poses[videoView]);
            const auto& corners = video_.views[videoView].corners;
            videoMembers_.push_back({videoView, bundle.addView(false, corners, at->second)});
        }
        return at->second;
    }

    void addStill(RigBundle& bundle, int view, double offset) {
        const TargetView& still = still_.views[view];
        const auto shift = static_cast<std::int64_t>(std::llround(offset * 1e9));
        const auto nodes = track_.around({still.time.ns + shift});
        if (!nodes) {
            const int pose = bundle.addPose(*stillFit_.poses[view]);
            stillMembers_.push_back({view, bundle.addView(true, still.corners, pose)});
            return;
        }
        std::array<int, 4> poses{};
        std::array<double, 4> times{};
        for (int j = 0; j < 4; ++j) {
            poses[j] = poseOf(bundle, trackViews_[(*nodes)[j]]);
            times[j] = secondsBetween(still.time, track_.time((*nodes)[j]));
        }
        stillMembers_.push_back({view, bundle.addTied(still.corners, poses, times)});
        ++pairs_;
    }

    [[nodiscard]] RigBundle assembled(double offset) {
        videoPoses_.clear();
        videoMembers_.clear();
        stillMembers_.clear();
        pairs_ = 0;
        RigBundle bundle(target_, {videoFit_.camera, stillFit_.camera, start_.T_still_video},
                         offset);
        for (const int view : videoFit_.chosen)
            poseOf(bundle, view);
        for (const int view : stillFit_.chosen)
            addStill(bundle, view, offset);
        requirePairs(pairs_);
        return bundle;
    }

    [[nodiscard]] RigBundle adjusted(double offset, bool withOffset, Calibration& out) {
        std::array<bool, kShared> fixed{};
        fixed[8] = fixed[kStillAt + 8] = !options_.k3;
        fixed[kOffsetAt] = !withOffset || options_.maxOffset == 0;
        RigBundle bundle = assembled(offset);
        bundle.solve({videoFit_.sigma, stillFit_.sigma}, fixed);
        out.offsetKnown = withOffset && options_.maxOffset > 0 &&
                          bundle.deviations()[kOffsetAt] <= kMaxOffsetDeviation;
        return bundle;
    }

    bool leaveOut(const RigBundle& bundle) {
        // The poses of track_ are used, because they come from the video alone. The bundle's video
        // poses are adjusted to the stills, because stills are more precise than video. So with the
        // bundle's poses, a still with an error would seem to fit.
        const auto shift = static_cast<std::int64_t>(std::llround(bundle.offset() * 1e9));
        // Stills that are not tied to video poses have much smaller residuals than the others, so
        // both kinds are judged apart.
        std::vector<int> tied, others;
        std::vector<double> tiedErrors, otherErrors;
        for (const Member& m : stillMembers_) {
            const TargetView& view = still_.views[m.view];
            const auto T_video_target = track_.at({view.time.ns + shift});
            (T_video_target ? tied : others).push_back(m.view);
            (T_video_target ? tiedErrors : otherErrors)
                .push_back(rms(T_video_target
                                   ? residualsOf(target_, view, bundle.rig().still,
                                                 bundle.rig().T_still_video * *T_video_target)
                                   : bundle.residuals(m.index)));
        }
        const bool anyTied = leaveOut(tied, tiedErrors), anyOther = leaveOut(others, otherErrors);
        return anyTied || anyOther;
    }

    bool leaveOut(const std::vector<int>& stills, const std::vector<double>& errors) {
        const std::vector<bool> bad = outliers(errors);
        for (std::size_t k = 0; k < bad.size(); ++k) {
            if (!bad[k]) continue;
            stillFit_.poses[stills[k]].reset();
            std::erase(stillFit_.chosen, stills[k]);
        }
        return std::ranges::count(bad, true) > 0;
    }

    [[nodiscard]] SensorResult result(const RigBundle& bundle, const SensorViews& sensor,
                                      const CameraFit& fit, const std::vector<Member>& members,
                                      bool still) const {
        SensorResult out;
        out.camera = still ? bundle.rig().still : bundle.rig().video;
        out.deviations = bundle.deviations().segment<9>(still ? kStillAt : 0);
        double sum = 0;
        std::size_t corners = 0;
        for (const Member& m : members) {
            const TargetView& view = sensor.views[m.view];
            out.views.push_back({view.time, view.corners, bundle.residuals(m.index), true});
            for (const Eigen::Vector2d& r : out.views.back().residuals)
                sum += r.squaredNorm();
            corners += view.corners.size();
        }
        out.rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, corners)));
        for (std::size_t i = 0; i < fit.poses.size(); ++i) {
            if (fit.poses[i]) continue;
            const TargetView& view = sensor.views[i];
            const auto pose = targetPose(target_, view, out.camera);
            out.views.push_back({view.time, view.corners, {}, false});
            if (pose) out.views.back().residuals = residualsOf(target_, view, out.camera, *pose);
        }
        std::ranges::sort(out.views, {}, [](const ViewResult& v) { return v.time.ns; });
        return out;
    }

    const Target& target_;
    SensorViews video_, still_;  ///< corners that do not fit are removed
    SolveOptions options_;
    CameraFit videoFit_, stillFit_;
    PoseTrack track_;
    std::vector<int> trackViews_;  ///< for each pose of track_: index in `video_.views`
    RigStart start_;
    std::map<int, int> videoPoses_;  ///< index in `video_.views` -> index of the pose in RigBundle
    std::vector<Member> videoMembers_, stillMembers_;
    int pairs_ = 0;
};

void checkCertainty(const Calibration& c) {
    for (const SensorResult* sensor : {&c.video, &c.still}) {
        const double focal = sensor->deviations.head<2>().maxCoeff() / sensor->camera.fx;
        if (!(focal <= kMaxFocalDeviation))
            throw Unsuitable(
                fmt::format("the views leave the focal length of the {} sensor uncertain by "
                            "{:.1f} %: tilt the target more and come closer",
                            sensor == &c.video ? "video" : "still", 100 * focal));
    }
    const double baseline = c.extrinsicDeviations.tail<3>().maxCoeff();
    if (!(baseline <= kMaxBaselineDeviation))
        throw Unsuitable(
            fmt::format("the views leave the distance between the sensors uncertain by "
                        "{:.1f} mm: take more stills close to the target",
                        1000 * baseline));
}

}  // namespace

Calibration calibrate(const Target& target, const SensorViews& video, const SensorViews& still,
                      const SolveOptions& options) {
    const Guesses guesses{guessedCamera(target, video.views, video.picture),
                          guessedCamera(target, still.views, still.picture)};
    checkViews(target, video.views, guesses.video, "video", kLeastVideoViews);
    checkViews(target, still.views, guesses.still, "still", kLeastStillViews);
    Calibration out = Assembly(target, video, still, guesses, options).run();
    checkCertainty(out);
    return out;
}

}  // namespace mfar::calibration
