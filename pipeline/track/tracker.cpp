#include "pipeline/track/tracker.h"

#include "pipeline/track/search_regions.h"
#include "pipeline/track/tag_pose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {
namespace {

// If the regions around the expected tags cover a larger share of the picture than this, the whole
// picture is searched instead, which is then as fast.
constexpr double kWorthwhile = 0.6;
// Without a tag map, the first usable tag becomes the world. If the filter accepts the pose of this
// number of frames, the tag stays the world for ever. A false detection does not last that long.
constexpr int kProven = 5;

PixelRect wholeOf(Size size) {
    return {0, 0, size.width, size.height};
}

double areaOf(const TagDetection& tag) {
    double area = 0;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d &a = tag.corners[k], &b = tag.corners[(k + 1) % 4];
        area -= (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return area;
}

void require(bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("tracker: ") + what);
}

}  // namespace

Tracker::Eye Tracker::eye(const CameraModel& camera, double decimation, double gamma,
                          const TrackerOptions& options) {
    DetectorOptions detector;
    detector.families = options.map.empty() ? options.families : options.map.families();
    detector.decimation = decimation;
    detector.threads = options.threads;
    return {camera, decimation, TagDetector(detector), CornerRefiner(gamma), {}};
}

Tracker::Tracker(const StereoRig& rig, TrackerOptions options)
    : rig_(rig), options_(std::move(options)),
      video_(eye(rig.video, options_.decimation, options_.gamma, options_)),
      still_(eye(rig.still, options_.stillDecimation, options_.stillGamma, options_)),
      map_(options_.map), estimator_(options_.pose) {
    require(options_.tagSize > 0 && std::isfinite(options_.tagSize), "tagSize must be positive");
    require(options_.fullSearchInterval >= 1, "fullSearchInterval must be positive");
}

std::vector<TagDetection> Tracker::search(Eye& eye, const ImageView& picture,
                                          const std::vector<PixelRect>& regions) {
    std::vector<TagDetection> out;
    for (const PixelRect& region : regions) {
        // Luma is needed beyond the region, because the detector enlarges the region to its grid of
        // tiles, and the corner refiner reads slightly more.
        const int over = static_cast<int>(4 * eye.decimation) + 8;
        const ImageView luma = eye.luma.of(
            picture, {region.x0 - over, region.y0 - over, region.x1 + over, region.y1 + over});
        for (TagDetection& tag : eye.detector.detect(luma, region)) {
            eye.refiner.refine(luma, eye.camera, tag);
            out.push_back(std::move(tag));
        }
    }
    return out;
}

std::vector<PixelRect> Tracker::regionsFor(const CameraModel& camera,
                                           const RigidTransform& T_camera_video,
                                           Timestamp time) const {
    const std::scoped_lock lock(mutex_);
    const auto predicted = estimator_.predict(time);
    if (!predicted || map_.empty()) return {};
    auto regions = searchRegions(map_, camera, predicted->T_world_video * T_camera_video.inverse(),
                                 moved(predicted->covariance, T_camera_video));
    const double all = static_cast<double>(camera.size.width) * camera.size.height;
    if (mfar::areaOf(regions) > kWorthwhile * all) regions.clear();
    return regions;
}

std::vector<TagDetection> Tracker::searchVideo(const ImageView& picture, Timestamp time) {
    if (++sinceFullSearch_ < options_.fullSearchInterval) {
        const auto regions = regionsFor(rig_.video, {}, time);
        auto found = search(video_, picture, regions);
        const std::scoped_lock lock(mutex_);
        const bool anyKnown = std::any_of(found.begin(), found.end(), [&](const TagDetection& tag) {
            return map_.find(tag.tag) != nullptr;
        });
        if (anyKnown) {
            ++stats_.roiSearches;
            return found;
        }
    }
    sinceFullSearch_ = 0;
    auto found = search(video_, picture, {wholeOf(picture.size)});
    const std::scoped_lock lock(mutex_);
    ++stats_.fullSearches;
    return found;
}

// The largest tag whose pose can be computed becomes the world.
void Tracker::adoptWorld(std::vector<TagDetection> tags) {
    std::ranges::sort(tags, std::greater(), [](const TagDetection& tag) { return areaOf(tag); });
    const RigidTransform T_world_tag = standOnTag().inverse();
    const auto usable = std::ranges::find_if(tags, [&](const TagDetection& tag) {
        const TagObservation seen{options_.tagSize, T_world_tag, tag.corners};
        return solveTagPose({&seen, 1}, rig_.video, options_.pose.tagPose).has_value();
    });
    if (usable == tags.end()) return;
    map_ = TagMap({{usable->tag, options_.tagSize, T_world_tag}});
    worldFrames_ = 0;
    ++world_;
}

void Tracker::proveWorld(const std::optional<Pose>& filtered) {
    if (!filtered)
        map_ = {};
    else if (filtered->tags > 0)
        ++worldFrames_;
}

bool Tracker::isProven() const {
    return !options_.map.empty() || worldFrames_ >= kProven;
}

std::optional<Pose> Tracker::inThisWorld(std::optional<Pose> pose) const {
    if (pose) pose->world = world_;
    return pose;
}

std::vector<TagObservation> Tracker::placed(const std::vector<TagDetection>& tags) const {
    std::vector<TagObservation> out;
    for (const TagDetection& tag : tags)
        if (const MappedTag* known = map_.find(tag.tag))
            out.push_back({known->size, known->T_world_tag, tag.corners});
    return out;
}

std::optional<Pose> Tracker::track(const ImageView& picture, Timestamp time) {
    require(picture.size == rig_.video.size, "the size of the frame differs from the calibration");
    const auto begin = std::chrono::steady_clock::now();
    detections_ = searchVideo(picture, time);
    const std::scoped_lock lock(mutex_);
    if (map_.empty()) adoptWorld(detections_);
    const auto out = inThisWorld(estimator_.update(placed(detections_), rig_.video, time));
    if (!isProven()) proveWorld(out);
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    count(span.count());
    return out;
}

std::optional<Pose> Tracker::trackStill(const ImageView& still, Timestamp time) {
    require(still.size == rig_.still.size, "the size of the still differs from the calibration");
    const auto observe = [&](const std::vector<PixelRect>& regions) {
        const auto tags = search(still_, still, regions);
        const std::scoped_lock lock(mutex_);
        return inThisWorld(estimator_.measure(placed(tags), rig_.still, rig_.T_still_video, time));
    };
    const auto regions = regionsFor(rig_.still, rig_.T_still_video, time);
    if (!regions.empty())
        if (auto pose = observe(regions)) return pose;
    return observe({wholeOf(still.size)});
}

std::optional<Pose> Tracker::raw() const {
    const std::scoped_lock lock(mutex_);
    return estimator_.raw();
}

std::optional<Pose> Tracker::predict(Timestamp time) const {
    const std::scoped_lock lock(mutex_);
    return estimator_.predict(time);
}

void Tracker::count(double ms) {
    ++stats_.frames;
    stats_.lastMs = ms;
    stats_.meanMs += (ms - stats_.meanMs) / static_cast<double>(stats_.frames);
    stats_.worstMs = std::max(stats_.worstMs, ms);
}

TrackStats Tracker::stats() const {
    const std::scoped_lock lock(mutex_);
    TrackStats out = stats_;
    out.flips = estimator_.flips();
    out.rejected = estimator_.rejected();
    out.jumps = estimator_.jumps();
    return out;
}

TagMap Tracker::map() const {
    const std::scoped_lock lock(mutex_);
    return isProven() ? map_ : TagMap();
}

}  // namespace mfar
