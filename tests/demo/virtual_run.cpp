#include "tests/demo/virtual_run.h"

#include "daemon/virtual_world.h"
#include "tests/demo/picture_layout.h"
#include "tests/demo/still_feed.h"
#include "tests/measure/eval/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mfar::demo {
namespace {

constexpr std::chrono::milliseconds kFrameInterval{33};
// The path tracer renders the exact view only after the camera has rested for some frames. So the
// last frame is repeated until the tracer's picture is finished, and the tracer has noticed more
// than kLeastLooks repetitions (it skips some). There are at most kMostRestFrames repetitions.
constexpr int kLeastLooks = 15, kMostRestFrames = 20000;

bool isSettled(const TracedLayerCounters& counters) {
    return counters.render.idle && counters.render.progress >= 1;
}

cv::Rect outputRect(const PixelRect& video, Size frame, Size output) {
    const auto at = [](int pixel, int from, int to) {
        return static_cast<int>(static_cast<std::int64_t>(pixel) * to / from);
    };
    return {cv::Point(at(video.x0, frame.width, output.width),
                      at(video.y0, frame.height, output.height)),
            cv::Point(at(video.x1, frame.width, output.width),
                      at(video.y1, frame.height, output.height))};
}

cv::Rect detailOf(const cv::Rect& region, cv::Size picture) {
    const cv::Size window = detailSize(picture);
    const cv::Point middle = (region.tl() + region.br()) / 2;
    return {{std::clamp(middle.x - window.width / 2, 0, picture.width - window.width),
             std::clamp(middle.y - window.height / 2, 0, picture.height - window.height)},
            window};
}

class Show {
public:
    Show(const Recording& recording, const Config& config)
        : recording_(recording), poses_(recording, eval::PoseSource::Tags),
          pipeline_(recording.rig, {}), world_(config.virtualLayer, recording.rig, pipeline_),
          stills_(recording, &poses_) {
        world_.set(config.objects, config.light, {});
    }

    void frame(const RecordedImage& image) {
        rgba_ = eval::toRgba(eval::loadPicture(image.file));
        pose_ = poses_.of(image.time, image.time).frame;
        time_ = image.time;
        stills_.feed(pipeline_, time_);
        show();
    }
    void again() {
        time_ = time_ + kFrameInterval;
        show();
    }
    [[nodiscard]] cv::Mat picture() const {
        return eval::fromRgba(pipeline_.readImage(), pipeline_.outputSize());
    }
    [[nodiscard]] TracedLayerCounters counters() const {
        return pipeline_.tracedCounters().value_or(TracedLayerCounters{});
    }
    [[nodiscard]] cv::Rect region() const {
        return outputRect(pipeline_.objectsRegion(), recording_.rig.video.size,
                          pipeline_.outputSize());
    }

private:
    void show() { pipeline_.run(eval::viewOf(rgba_), time_, pose_); }

    const Recording& recording_;
    eval::KnownPoses poses_;
    Pipeline pipeline_;
    VirtualWorld world_;
    StillFeed stills_;
    cv::Mat rgba_;
    std::optional<Pose> pose_;
    Timestamp time_;
};

}  // namespace

VirtualRun runVirtual(const Recording& recording, const Config& config,
                      const std::function<void(int, int)>& progress) {
    Show show(recording, config);
    const int all = static_cast<int>(recording.video.size());
    for (int done = 1; done <= all; ++done) {
        show.frame(recording.video[static_cast<std::size_t>(done - 1)]);
        progress(done, 2 * all);
    }
    VirtualRun run;
    run.moving = show.picture();
    run.moved = show.counters();
    run.region = show.region();
    if (run.region.empty())
        throw std::runtime_error(recording.root.string() +
                                 ": no virtual object is in view in the last frame");
    Timestamp seen = show.counters().render.frame;
    int looks = 0;  // number of repetitions that the path tracer has noticed
    for (int i = 0; i < kMostRestFrames && !(looks > kLeastLooks && isSettled(show.counters()));
         ++i) {
        show.again();
        if (show.counters().render.frame == seen) continue;
        seen = show.counters().render.frame;
        ++looks;
        progress(all + std::min(looks, all - 1), 2 * all);
    }
    // The last samples are finished now, but only a later frame shows them.
    for (int i = 0; i < 5; ++i) {
        std::this_thread::sleep_for(kFrameInterval);
        show.again();
    }
    progress(2 * all, 2 * all);
    run.atRest = show.picture();
    run.rested = show.counters();
    return run;
}

cv::Mat virtualPicture(const VirtualRun& run) {
    const std::array<Column, 2> columns{
        Column{"The camera moves: an older picture, warped", run.moving},
        Column{
            fmt::format("At rest: {:.1f} million samples later",
                        static_cast<double>(run.rested.render.samples - run.moved.render.samples) *
                            1e-6),
            run.atRest}};
    return columnsWithDetail(columns, detailOf(run.region, run.moving.size()));
}

}  // namespace mfar::demo
