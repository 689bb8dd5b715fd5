#include "pipeline/pipeline.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace mfar::stress {
namespace {

std::optional<Pose> poseFor(Context& c, double unit) {
    if (c.hostile.chance(0.25)) return std::nullopt;
    Pose pose;
    pose.T_world_video = c.hostile.chance(0.6) ? c.hostile.gentle(unit) : c.hostile.motion(unit);
    if (c.hostile.chance(0.15)) pose.T_world_video = c.hostile.spoilt(pose.T_world_video);
    pose.covariance = c.hostile.covariance();
    return pose;
}

/// Chooses one engine for all steps, or an engine for each step. Between steps of different
/// engines, buffers are transferred between host and GPU.
EngineChoice enginesFor(Context& c) {
    const auto kind = [&] { return c.hostile.pick({EngineKind::Gles, EngineKind::Simd}); };
    if (c.hostile.chance(0.6)) return EngineChoice::all(kind());
    return {kind(), kind(), kind(), kind(), kind(), kind()};
}

constexpr int kMostOutput = 4096;

/// An object in front of, around or behind the camera, or across the camera's plane. It may be tiny
/// or huge.
VirtualObject objectFor(Context& c, double unit) {
    VirtualObject o;
    o.shape = c.hostile.pick({VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad});
    o.size = unit * Eigen::Vector3d(c.hostile.logarithmic(1e-3, 30), c.hostile.logarithmic(0.1, 3),
                                    c.hostile.logarithmic(1e-3, 30));
    o.T_world_object = {c.hostile.turn(),
                        unit * Eigen::Vector3d(c.hostile.real(-1, 1), c.hostile.real(-1, 1),
                                               c.hostile.pick({0.0, 0.5, 1.0, 3.0, -1.0}))};
    if (c.hostile.chance(0.1)) o.T_world_object = c.hostile.spoilt(o.T_world_object);
    if (c.hostile.chance(0.1)) o.size[c.hostile.integer(0, 2)] = c.hostile.bad();
    return o;
}

void checkDepth(Context& c, const Pipeline& p) {
    const InverseDepthField& depth = p.inverseDepth();
    for (std::size_t i = 0; i < depth.inverseDepth.size(); ++i) {
        c.checks.within(depth.inverseDepth[i], 0, 1e30, "real inverse depth");
        c.checks.require(depth.variance[i] >= 0,
                         "variance of real inverse depth is negative or NaN");
    }
}

void checkPipeline(Context& c, const Pipeline& p, const StereoRig& rig) {
    for (const float v : p.readFlow())
        c.checks.within(v, -2e4, 2e4, "component of a flow vector [px]");
    for (const float v : p.readConfidence())
        c.checks.within(v, 0, 1, "confidence of a pixel");
    for (const float v : p.readShownObjects())
        c.checks.within(v, 0, 1, "visible share of an object's pixel");
    const FrameStats s = p.readStats();
    for (const double v : {s.meanConfidence, s.explained, s.changed, s.redrawn})
        c.checks.within(v, 0, 1, "mean confidence of a frame, or a share of its tiles");
    c.checks.within(s.epipolarError, 0, 1e7, "median distance from epipolar lines [px]");
    c.gl.frame(c.checks, pixelsOf(rig.video.size));
}

void frames(Context& c) {
    const StereoRig rig = hostileRig(c);
    const double unit = c.hostile.pick({1e-6, 1e-3, 1.0, 1.0, 1.0, 1e3});
    PipelineOptions options;
    options.mode =
        c.hostile.pick({SuperResMode::Detail, SuperResMode::Detail, SuperResMode::Blend});
    options.depthEverywhere = c.hostile.chance(0.5);
    options.engines = enginesFor(c);
    if (c.scale == Scale::Product)
        options.output = c.hostile.pick({rig.still.size, Size{1440, 1080}, Size{1067, 800}});
    // The default output is as wide as the still. If the still is narrower than the video, or so
    // wide that the output could exceed the largest texture, the output gets another size.
    const Size full = Pipeline::fullSize(rig);
    if (c.scale == Scale::Mixed || rig.still.size.width < rig.video.size.width ||
        std::max(full.width, full.height) > kMostOutput)
        options.output = {2 * rig.video.size.width, 2 * rig.video.size.height};
    Pipeline pipeline(rig, options);
    const bool hasObjects = c.hostile.chance(0.7);
    if (hasObjects) {
        std::vector<VirtualObject> objects;
        for (int i = c.hostile.integer(1, 3); i > 0; --i)
            objects.push_back(objectFor(c, unit));
        pipeline.setObjects(objects);
    }
    Timestamp time{};
    // More frames are run at Scale::Product, because creating a pipeline takes as long as several
    // frames.
    const int count = c.scale == Scale::Product ? 12 : 5;
    for (int frame = 0; frame < count; ++frame) {
        if (frame == 0 || c.hostile.chance(0.3))
            pipeline.setStill(c.hostile.picture(rig.still.size).view(), time, poseFor(c, unit));
        time = time + std::chrono::milliseconds(c.hostile.pick({33, 0, -33, 100000}));
        pipeline.run(c.hostile.picture(rig.video.size).view(), time, poseFor(c, unit));
        if (hasObjects || options.depthEverywhere) checkDepth(c, pipeline);
        checkPipeline(c, pipeline, rig);
    }
}

double shiftError(const std::vector<float>& flow, const Eigen::Vector2d& shift) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < flow.size(); i += 2)
        errors.push_back(std::hypot(flow[i] - shift.x(), flow[i + 1] - shift.y()));
    std::ranges::nth_element(errors, errors.begin() + static_cast<long>(errors.size() / 2));
    return errors.empty() ? 1e9 : errors[errors.size() / 2];
}

// The picture must have the still's detail although the view has shifted since the still.
void knownTruth(Context& c) {
    const Size video = c.scale == Scale::Mixed && c.hostile.chance(0.1)
                           ? Size{640, 480}
                           : Size{c.hostile.integer(110, 170), c.hostile.integer(100, 130)};
    const StereoRig rig = plainRig(video, {video.width * 18 / 5, video.height * 18 / 5});
    const Waves waves(static_cast<unsigned>(c.hostile.integer(1, 1 << 30)), 1.2, 60, 40, 96);
    const Eigen::Vector2d shift(c.hostile.real(-3, 3), c.hostile.real(-3, 3));
    const auto fine = [&](Size size, const Eigen::Vector2d& at) {
        const double step = static_cast<double>(video.width) / size.width;
        return waves.shoot(size, {.step = step, .shift = at, .footprint = step});
    };
    PipelineOptions options;
    options.mode = c.hostile.pick({SuperResMode::Detail, SuperResMode::Blend});
    options.output = c.hostile.pick({rig.still.size, Size{2 * video.width, 2 * video.height}});
    options.engines = enginesFor(c);
    Pipeline pipeline(rig, options);
    pipeline.setQuality({.mode = options.mode, .learned = c.hostile.chance(0.5)});
    const TestPicture frame = waves.shoot(video, {.shift = shift});
    const auto truth = fine(pipeline.outputSize(), shift).bytes;
    pipeline.run(frame.view(), {});
    const double enlarged = psnr(pipeline.readImage(), truth);
    pipeline.setStill(fine(rig.still.size, {0, 0}).view(), {});
    pipeline.run(frame.view(), {});
    c.checks.within(psnr(pipeline.readImage(), truth) - enlarged, 0.5, 100,
                    "gain by the still [dB]");
    c.checks.within(shiftError(pipeline.readFlow(), shift), 0, 0.3, "error of a shift [px]");
    checkPipeline(c, pipeline, rig);
}

// The same scene in another unit of length must give the same flow.
void scaledWorld(Context& c) {
    const Size video{c.hostile.integer(64, 150), c.hostile.integer(64, 120)};
    StereoRig rig = bentRig(video, {3 * video.width, 3 * video.height});
    rig.T_still_video.translation = {0.014, 0, 0};
    const Waves waves(static_cast<unsigned>(c.hostile.integer(1, 1 << 30)), 2, 60, 40);
    const TestPicture frame = waves.shoot(video, {.shift = {3, 1}});
    const TestPicture still = waves.shoot(rig.still.size, {.step = 1 / 3.0, .footprint = 1 / 3.0});
    const RigidTransform moved = c.hostile.gentle();
    PipelineOptions options;
    options.engines = enginesFor(c);
    const auto flowIn = [&](double unit) {
        StereoRig scaled = rig;
        scaled.T_still_video.translation *= unit;
        Pose pose{{}, moved};
        pose.T_world_video.translation *= unit;
        Pipeline p(scaled, options);
        p.setStill(still.view(), {}, Pose{});
        p.run(frame.view(), {}, pose);
        c.gl.frame(c.checks, pixelsOf(video));
        return p.readFlow();
    };
    const auto metres = flowIn(1);
    const auto other = flowIn(c.hostile.pick({0x1p-20, 0x1p-10, 0x1p10}));
    c.checks.require(metres.size() == other.size(),
                     "the flow in a scaled world has another number of vectors");
    for (std::size_t i = 0; i < std::min(metres.size(), other.size()); ++i)
        c.checks.within(metres[i] - other[i], -2e-3, 2e-3, "flow in a scaled world");
}

}  // namespace

std::vector<Case> pipelineCases() {
    return {{"pipeline", frames, true},
            {"pipeline-truth", knownTruth},
            {"pipeline-scaled", scaledWorld}};
}

}  // namespace mfar::stress
