#include "tests/demo/demo_run.h"

#include "pipeline/pipeline.h"
#include "tests/demo/still_feed.h"
#include "tests/measure/eval/metrics/harm_rate.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/metrics/ssim.h"
#include "tests/measure/eval/picture.h"

#include <opencv2/imgproc.hpp>

#include <chrono>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace mfar::demo {
namespace {

constexpr int kBorder = 32;

cv::Mat lumaInside(const cv::Mat& picture) {
    const cv::Rect inside(kBorder, kBorder, picture.cols - 2 * kBorder, picture.rows - 2 * kBorder);
    return eval::luma(picture(inside));
}

void addQuality(const Shown& shown, Quality& sum) {
    const cv::Mat truth = lumaInside(shown.truth);
    const cv::Mat enlarged = lumaInside(shown.enlarged);
    const cv::Mat result = lumaInside(shown.result);
    sum.enlargedPsnrDb += eval::psnr(enlarged, truth);
    sum.resultPsnrDb += eval::psnr(result, truth);
    sum.enlargedSsim += eval::ssim(enlarged, truth);
    sum.resultSsim += eval::ssim(result, truth);
    sum.harmRate += eval::harmRate(result, enlarged, truth);
    ++sum.frames;
}

void addStats(const FrameStats& stats, Quality& sum) {
    sum.meanConfidence += stats.meanConfidence;
    const double tiles = std::accumulate(stats.tiles.begin(), stats.tiles.end(), 0.0);
    for (std::size_t i = 0; i < kTileClasses; ++i)
        sum.tileShares[i] += stats.tiles[i] / tiles;
}

void divideByFrames(Quality& sum) {
    const double n = sum.frames;
    for (double* value : {&sum.enlargedPsnrDb, &sum.resultPsnrDb, &sum.enlargedSsim,
                          &sum.resultSsim, &sum.harmRate, &sum.meanConfidence, &sum.frameMs})
        *value /= n;
    for (double& share : sum.tileShares)
        share /= n;
}

Shown shownBy(const Pipeline& pipeline, const cv::Mat& video, const cv::Mat& truth) {
    Shown out;
    const Size size = pipeline.outputSize();
    cv::resize(video, out.enlarged, {size.width, size.height}, 0, 0, cv::INTER_CUBIC);
    out.result = eval::fromRgba(pipeline.readImage(), size);
    out.truth = truth;
    out.confidence = pipeline.readConfidence();
    out.classes = pipeline.readTileClasses();
    out.video = {video.cols, video.rows};
    return out;
}

}  // namespace

DemoRun runDemo(const Recording& recording, EngineKind engine,
                const std::function<void(int, int)>& progress) {
    Pipeline pipeline(recording.rig, {.output = {}, .engines = EngineChoice::all(engine)});
    StillFeed stills(recording);
    DemoRun run;
    int done = 0;
    for (const RecordedImage& frame : recording.video) {
        const cv::Mat video = eval::loadPicture(frame.file);
        const cv::Mat rgba = eval::toRgba(video);
        stills.feed(pipeline, frame.time);
        const auto begun = std::chrono::steady_clock::now();
        const FrameResult& result = pipeline.run(eval::viewOf(rgba), frame.time);
        pipeline.finish(engine);
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begun;
        const auto truth = recording.truthHighRes(frame.time);
        if (truth && result.stats.usedStill) {
            addStats(result.stats, run.quality);
            run.quality.frameMs += took.count();
            run.last = shownBy(pipeline, video, eval::loadPicture(*truth));
            addQuality(run.last, run.quality);
        }
        progress(++done, static_cast<int>(recording.video.size()));
    }
    if (run.quality.frames == 0)
        throw std::runtime_error(recording.root.string() +
                                 ": no frame has both a true picture (truth/highres) and a still");
    divideByFrames(run.quality);
    return run;
}

}  // namespace mfar::demo
