#include "tests/measure/bench/warp_bench.h"

#include "pipeline/warp/warp.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/warp/cast_scene.h"
#include "tests/warp/warp_engine.h"

#include <opencv2/imgproc.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mfar::bench {
namespace {

constexpr double kTurn = 2;  // angle between traced and shown view on the camera's orbit [degrees]

Summary timed(int runs, const std::function<void()>& call) {
    std::vector<double> ms;
    call();
    for (int i = 0; i < runs; ++i)
        ms.push_back(eval::wallMs(call));
    return summarise(std::move(ms));
}

class WarpCase {
public:
    WarpCase(EngineKind engine, const test::CastScene& scene, Size size)
        : engine_(test::warpEngine(engine)),
          warp_(test::bentCamera(size), size, *engine_, {.filling = HoleFilling::PushPull}) {
        warp_.setScene(scene.scene());
        picture_ = scene.cast({warp_.camera(), test::orbit(0)});
        warp_.setTracedPicture(tracedPicture(picture_));
    }

    Summary frames(int runs, double degrees) {
        const RigidTransform pose = test::orbit(degrees);
        return timed(runs, [&] {
            warp_.run(pose);
            engine_->finish();
        });
    }
    Summary newPictures(int runs) {
        return timed(runs, [&] {
            warp_.setTracedPicture(tracedPicture(picture_));
            engine_->finish();
        });
    }

private:
    std::unique_ptr<Engine> engine_;
    Warp warp_;
    RenderedPicture picture_;
};

/// Times cv::remap for a small rotation about the first pixel. As in the warp, neighbouring pixels
/// of the result come from neighbouring pixels of the source, so memory is read in a similar order.
Summary timeRemap(Size size, int runs) {
    const cv::Mat4b from(size.height, size.width, cv::Vec4b(90, 120, 60, 255));
    cv::Mat2f map(from.size());
    for (int y = 0; y < map.rows; ++y)
        for (int x = 0; x < map.cols; ++x)
            map(y, x) = {static_cast<float>(x) + 0.03F * static_cast<float>(y),
                         static_cast<float>(y) - 0.03F * static_cast<float>(x)};
    cv::Mat to;
    return timed(runs, [&] { cv::remap(from, to, map, cv::noArray(), cv::INTER_LINEAR); });
}

}  // namespace

WarpTimes measureWarp(Size size, int runs, EngineKind engine) {
    WarpTimes out;
    WarpCase objects(engine, test::twoBalls(), size);
    out.objects = objects.frames(runs, kTurn);
    out.still = objects.frames(runs, 0);
    out.newPicture = objects.newPictures(runs);
    out.whole = WarpCase(engine, {{{{0, 0, 0.1}, 0.5}}, false, 1}, size).frames(runs, kTurn);
    out.remap = timeRemap(size, runs);
    return out;
}

}  // namespace mfar::bench
