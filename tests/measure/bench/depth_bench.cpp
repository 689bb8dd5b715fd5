#include "tests/measure/bench/depth_bench.h"

#include "pipeline/depth/depth_stage.h"
#include "pipeline/depth/edge_snap.h"
#include "tests/measure/eval/stopwatch.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <memory>
#include <vector>

namespace mfar::bench {
namespace {

constexpr std::size_t kFirstFrames = 6;  // frames before a keyframe exists
constexpr double kNeverEnough = 0.001;

Summary measureIn(const Workload& posed, const PixelRect& where) {
    const CameraModel& camera = posed.rig.video;
    auto workers = std::make_shared<Workers>();
    DepthOptions options;
    options.enough = kNeverEnough;
    DepthStage stage(camera, workers, options);
    EdgeSnap snap(camera.size, workers);
    LumaImage luma;
    std::vector<double> ms;
    for (std::size_t i = 0; i < posed.frames.size(); ++i) {
        if (!posed.framePoses[i]) continue;
        cv::Mat rgba;
        cv::cvtColor(posed.frames[i], rgba, cv::COLOR_BGR2RGBA);
        const ImageView view{rgba.data, camera.size, rgba.step[0], PixelFormat::Rgba8};
        const double time = eval::wallMs([&] {
            lumaOf(view, luma);
            stage.run(luma, *posed.framePoses[i], {}, where);
            snap.run(stage.field(), view, where);
        });
        if (i >= kFirstFrames && stage.source() == DepthSource::Keyframe) ms.push_back(time);
    }
    return summarise(std::move(ms));
}

}  // namespace

DepthTimes measureDepth(const Workload& posed) {
    if (posed.framePoses.size() < posed.frames.size()) return {};
    const Size size = posed.rig.video.size;
    const double side = std::sqrt(0.1);
    const int width = static_cast<int>(std::lround(side * size.width));
    const int height = static_cast<int>(std::lround(side * size.height));
    const int x = (size.width - width) / 2, y = (size.height - height) / 2;
    return {measureIn(posed, {x, y, x + width, y + height}),
            measureIn(posed, {0, 0, size.width, size.height})};
}

}  // namespace mfar::bench
