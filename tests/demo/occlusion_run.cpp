#include "tests/demo/occlusion_run.h"

#include "hal/virtual/synthetic_truth.h"
#include "pipeline/composite/preview_renderer.h"
#include "tests/demo/still_feed.h"
#include "tests/measure/eval/metrics/depth_error.h"
#include "tests/measure/eval/metrics/occlusion_score.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/scene_run.h"
#include "tests/measure/eval/virtual_truth.h"

#include <opencv2/imgproc.hpp>

#include <cstdint>
#include <stdexcept>

namespace mfar::demo {
namespace {

constexpr int kSettling = 8;

cv::Mat depthOf(const InverseDepthField& field) {
    cv::Mat out(field.size.height, field.size.width, CV_32F, cv::Scalar(0));
    for (std::size_t i = 0; i < field.inverseDepth.size(); ++i)
        if (field.isKnown(i)) out.ptr<float>()[i] = field.inverseDepth[i];
    return out;
}

/// Makes two pictures of a frame and two masks. In the true picture, real surfaces occlude the
/// objects; in the other, the objects are drawn over everything. The masks are those of
/// OcclusionShown.
class SceneTruth {
public:
    SceneTruth(const Recording& recording, synthetic::Scene scene,
               const std::vector<VirtualObject>& objects, Size output)
        : recording_(recording), world_(synthetic::makeWorld(scene, 1)), objects_(objects),
          output_(output), renderer_(recording.rig.video, output) {}

    void fill(OcclusionShown& shown, Timestamp time, const Pose& pose) {
        const CameraModel camera = recording_.rig.video.scaledTo(output_);
        const eval::VirtualTruth truth =
            eval::virtualTruth(objects_, camera, pose.T_world_video,
                               synthetic::inverseDepth(world_, {camera, pose.T_world_video, 0}));
        const cv::Mat picture = eval::loadPicture(*recording_.truthHighRes(time));
        const VirtualLayer& layer = renderer_.render(objects_, pose.T_world_video);
        const std::vector<std::uint8_t> rgba = layer.colour->readRgba8();
        const cv::Mat colours = eval::fromRgba(rgba, output_);
        cv::Mat drawn;
        cv::extractChannel(
            cv::Mat(output_.height, output_.width, CV_8UC4, const_cast<std::uint8_t*>(rgba.data())),
            drawn, 3);
        shown.overlaid = picture.clone();
        colours.copyTo(shown.overlaid, drawn);
        shown.trueComposite = picture.clone();
        colours.copyTo(shown.trueComposite, drawn & truth.visible);
        shown.visible = truth.visible;
        shown.hidden = truth.silhouette & ~truth.visible;
    }

private:
    const Recording& recording_;
    synthetic::World world_;
    const std::vector<VirtualObject>& objects_;
    Size output_;
    PreviewRenderer renderer_;
};

void score(const Pipeline& pipeline, const Recording& recording,
           const std::vector<VirtualObject>& objects, const Pose& pose, const FloatImage& real,
           OcclusionRun& run) {
    const cv::Mat wanted(real.size.height, real.size.width, CV_32F,
                         const_cast<float*>(real.values.data()));
    run.last.depth = depthOf(pipeline.inverseDepth());
    run.last.trueDepth = wanted.clone();
    const eval::DepthError depth =
        eval::depthError(run.last.depth, wanted, 1, cv::Mat(wanted.size(), CV_8U, cv::Scalar(255)));
    const eval::VirtualTruth truth =
        eval::virtualTruth(objects, recording.rig.video, pose.T_world_video, real);
    const eval::OcclusionScore seen = eval::occlusionScore(
        eval::shownAtVideo(eval::shownObjects(pipeline), real.size), truth.visible);
    run.quality.absrel += depth.absrel;
    run.quality.completeness += depth.completeness;
    run.quality.overlap += seen.overlap;
    run.quality.boundary += seen.boundary;
    ++run.quality.frames;
}

void divideByFrames(OcclusionQuality& sum) {
    for (double* value : {&sum.absrel, &sum.completeness, &sum.overlap, &sum.boundary})
        *value /= sum.frames;
}

}  // namespace

OcclusionRun runOcclusion(const Recording& recording, synthetic::Scene scene,
                          const std::vector<VirtualObject>& objects, EngineKind engine,
                          const std::function<void(int, int)>& progress) {
    const eval::KnownPoses poses(recording, eval::PoseSource::Tags);
    Pipeline pipeline(
        recording.rig,
        {.output = {}, .depthEverywhere = true, .engines = EngineChoice::all(engine)});
    pipeline.setObjects(objects);
    StillFeed stills(recording, &poses);
    SceneTruth sceneTruth(recording, scene, objects, pipeline.outputSize());
    OcclusionRun run;
    const int all = static_cast<int>(recording.video.size());
    for (int done = 1; done <= all; ++done) {
        const RecordedImage& frame = recording.video[static_cast<std::size_t>(done - 1)];
        const cv::Mat rgba = eval::toRgba(eval::loadPicture(frame.file));
        stills.feed(pipeline, frame.time);
        pipeline.run(eval::viewOf(rgba), frame.time, poses.of(frame.time, frame.time).frame);
        progress(done, all);
        const auto depth = recording.truthInverseDepth(frame.time);
        const auto pose = recording.poseAt(frame.time);
        if (done <= kSettling || !depth || !pose || !recording.truthHighRes(frame.time)) continue;
        score(pipeline, recording, objects, *pose, loadPfm(*depth), run);
        if (done < all) continue;
        run.last.composite = eval::fromRgba(pipeline.readImage(), pipeline.outputSize());
        sceneTruth.fill(run.last, frame.time, *pose);
    }
    if (run.last.composite.empty())
        throw std::runtime_error(recording.root.string() +
                                 ": the last frame must follow at least eight others and needs a "
                                 "pose and the true pictures in truth/inverse_depth and "
                                 "truth/highres");
    divideByFrames(run.quality);
    return run;
}

}  // namespace mfar::demo
