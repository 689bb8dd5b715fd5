#include "tests/measure/bench/governor_run.h"

#include "daemon/governor.h"
#include "tests/measure/bench/scene_frames.h"
#include "tests/measure/eval/picture.h"

#include <GLES3/gl31.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace mfar::bench {
namespace {

constexpr int kStillEvery = 30;  // frames between two stills
constexpr std::chrono::milliseconds kInterval{33};

struct Shots {
    std::string name;
    std::vector<SceneFrame> frames;
};

Shots shotsOf(synthetic::Scene which, synthetic::Path path, const char* name, bool quick, int count,
              StereoRig& rig) {
    SyntheticOptions options;
    options.scene = which;
    options.path = path;
    if (quick) options.rig = synthetic::boardRig(kQuickVideo, kQuickStill);
    eval::SceneRun scene(options, eval::PoseSource::Recorded);
    rig = scene.rig();
    Shots out{name, {}};
    scene.fire();
    // Skips the frames before the first still, which arrives some frames after its trigger pulse.
    for (SceneFrame frame; std::cmp_less(out.frames.size(), count);) {
        frame = nextFrame(scene);
        if (out.frames.empty() && frame.still.empty()) continue;
        out.frames.push_back(std::move(frame));
        if (out.frames.size() % (kStillEvery / 2) == 0) scene.fire();
    }
    return out;
}

class Governed {
public:
    Governed(const StereoRig& rig, const std::vector<QualityLevel>& levels, double deadlineMs,
             Clock clock)
        : pipeline_(rig, {}), governor_(levels, deadlineMs), clock_(clock) {
        pipeline_.setQuality(governor_.level().quality);
    }

    GovernedScene show(const Shots& shots, int count) {
        GovernedScene out{shots.name, {}, {}};
        bool stillIsDue = true;
        const int last = static_cast<int>(shots.frames.size()) - 1;
        for (int i = 0; i < count; ++i) {
            const int there = i % std::max(2 * last, 1);
            const SceneFrame& frame = shots.frames[std::min(there, 2 * last - there)];
            stillIsDue = stillIsDue || i % kStillEvery == 0;
            const bool takes = stillIsDue && !frame.still.empty() && governor_.mayTakeStill();
            if (takes) stillIsDue = false;
            ++out.levels[governor_.level().name];
            out.ms.push_back(run(frame, takes));
        }
        return out;
    }

private:
    double run(const SceneFrame& frame, bool newStill) {
        time_ = time_ + kInterval;
        FrameStats stats;
        const double ms = msOf(clock_, [&] {
            if (newStill) pipeline_.setStill(eval::viewOf(frame.still), time_, frame.stillPose);
            stats = pipeline_.run(eval::viewOf(frame.picture), time_, frame.pose).stats;
            glFinish();
        });
        const Governor::Choice before = governor_.next();
        governor_.add({ms, newStill, stats.usedStill, stats.redrawn});
        if (!(governor_.next() == before)) {
            pipeline_.setQuality(governor_.level().quality);
            if (governor_.next().redraw) pipeline_.redraw();
        }
        return ms;
    }

    Pipeline pipeline_;
    Governor governor_;
    Clock clock_;
    Timestamp time_{};
};

}  // namespace

std::vector<GovernedRun> measureGovernor(const GovernorRequest& request,
                                         const std::vector<QualityLevel>& levels) {
    using synthetic::Path, synthetic::Scene;
    const int distinct = std::max(request.frames / 2, 1);
    StereoRig rig;
    std::vector<Shots> scenes;
    const auto add = [&](Scene scene, Path path, const char* name) {
        scenes.push_back(shotsOf(scene, path, name, request.quick, distinct, rig));
    };
    add(Scene::Office, Path::Handheld, "office");
    add(Scene::Still, Path::Rest, "still");
    add(Scene::Flat, Path::Handheld, "flat");
    add(Scene::Moving, Path::Handheld, "moving");
    std::vector<GovernedRun> out;
    for (const double deadline : request.deadlinesMs) {
        const ProgressPart progress = request.progress.part(
            out.size(), request.deadlinesMs.size(), fmt::format("deadline {:g} ms", deadline));
        GovernedRun& run = out.emplace_back(GovernedRun{deadline, {}});
        Governed governed(rig, levels, deadline, request.clock);
        for (const Shots& shots : scenes) {
            progress.show(run.scenes.size(), scenes.size(), shots.name);
            run.scenes.push_back(governed.show(shots, request.frames));
        }
    }
    return out;
}

}  // namespace mfar::bench
