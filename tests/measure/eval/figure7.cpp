#include "tests/measure/eval/figure7.h"

#include "hal/bgr_picture.h"
#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/scene_run.h"
#include "tests/measure/eval/still_learning.h"
#include "tests/measure/eval/superres_learning.h"
#include "tests/measure/eval/superres_methods.h"
#include "tests/measure/eval/superres_samples.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <utility>

namespace mfar::eval {
namespace {

constexpr int kStillEvery = 10;
constexpr int kScoredFrame = 5;  // the fifth frame after the request of a still is measured

class Figure7Run {
public:
    Figure7Run(const Figure7Request& request, std::string name, const StereoRig& rig,
               SuperResFactory& factory, const ProgressPart& progress)
        : request_(request), progress_(progress) {
        scene_.name = std::move(name);
        for (const Figure7Method& method : figure7Methods())
            if (method.name != std::string("truth"))
                methods_.push_back(factory.create(method.name, rig));
        scene_.scores.resize(methods_.size() + 1);
    }

    void setStill(const Shot& still) {
        if (stillTime_ == still.time) return;
        for (const auto& method : methods_)
            method->setStills(still, nullptr);
        stillTime_ = still.time;
    }

    void measure(const Shot& frame, const cv::Mat& truth) {
        const std::string name = std::to_string(frame.time.ns);
        const auto done = scene_.frames.size(), all = static_cast<std::size_t>(request_.frames);
        progress_.show(done, all, frameOf(done, all));
        scene_.frames.push_back(name);
        const cv::Mat wanted = luma(withoutBorder(truth));
        for (std::size_t i = 0; i < scene_.scores.size(); ++i) {
            const cv::Mat picture = i == 0 ? truth : methods_[i - 1]->run(frame).picture;
            scene_.scores[i].push_back(
                scoreOf(luma(withoutBorder(picture)), wanted, request_.metrics));
            save(name, figure7Methods()[i].name, picture);
        }
    }

    [[nodiscard]] const Figure7Scene& result() const { return scene_; }

private:
    void save(const std::string& frame, const char* method, const cv::Mat& picture) const {
        if (request_.save.empty()) return;
        std::error_code error;
        std::filesystem::create_directories(request_.save, error);
        savePicture(request_.save / fmt::format("{}_{}_{}.png", scene_.name, frame, method),
                    picture);
    }

    const Figure7Request& request_;
    ProgressPart progress_;
    Figure7Scene scene_;
    std::vector<std::unique_ptr<SuperResMethod>> methods_;
    std::optional<Timestamp> stillTime_;
};

/// Learns filters from the next `stills` stills of this scene.
std::shared_ptr<const FilterBank> learnedFrom(SceneRun& board, int stills) {
    StillLearning learning;
    learning.begin(board.rig());
    Pipeline pipeline(board.rig(), {.output = {}, .skipUnchanged = false});
    pipeline.setMatchListener(&learning);
    for (int i = 0; i < kStillEvery * stills; ++i) {
        const SceneRun::Shots shots = board.next();
        if (i % kStillEvery == 0) board.fire();
        pipeline.setFilters(learning.filters());
        runOn(pipeline, shots);
    }
    learning.report();
    return learning.filters();
}

Figure7Scene ofScene(const Figure7Request& request, synthetic::Scene scene,
                     SuperResFactory& factory, const ProgressPart& progress) {
    SyntheticOptions options;
    options.scene = scene;
    SceneRun board(options, PoseSource::Recorded);
    if (request.learn > 0) factory.setFilters(learnedFrom(board, request.learn));
    Figure7Run run(request, std::string(synthetic::name(scene)), board.rig(), factory, progress);
    for (int i = 0; i < kStillEvery * (request.frames - 1) + kScoredFrame + 1; ++i) {
        const SceneRun::Shots shots = board.next();
        if (i % kStillEvery == 0) board.fire();
        if (shots.still)
            run.setStill({bgrPicture(shots.still->view()), shots.still->time(), shots.stillPose});
        if (i % kStillEvery != kScoredFrame) continue;
        const StoredImage truth = board.board().highRes(shots.frame.time());
        run.measure({bgrPicture(shots.frame.view()), shots.frame.time(), shots.pose},
                    bgrPicture(truth.view()));
    }
    return run.result();
}

Figure7Scene ofRecording(const Figure7Request& request, const std::filesystem::path& folder,
                         const std::string& name, SuperResFactory& factory,
                         const ProgressPart& progress) {
    const Recording recording = loadRecording(folder);
    if (request.learn > 0) {
        SuperResRequest asFor;
        asFor.learn = request.learn;
        factory.setFilters(learnedFilters(asFor, {folder}));
    }
    Figure7Run run(request, name, recording.rig, factory, progress);
    for (const SuperResSample& sample : superResSamplesOf(recording, request.frames)) {
        const PosePair poses = posesOf(recording, sample.video.time, sample.still.time);
        run.setStill({loadPicture(sample.still.file), sample.still.time, poses.still});
        run.measure({loadPicture(sample.video.file), sample.video.time, poses.frame},
                    loadHighRes(sample, recording.rig));
    }
    return run.result();
}

}  // namespace

std::vector<Figure7Scene> evaluateFigure7(const Figure7Request& request) {
    SuperResFactory factory(2);  // PaperOptions::alpha in the paper's experiments
    if (request.learn > 0) factory.requireContext();
    std::vector<Figure7Scene> out;
    const auto labels = labelsOf(request.recordings);
    const std::size_t all = request.scenes.size() + labels.size();
    const auto next = [&](std::string_view what) {
        const ProgressPart part = request.progress.part(out.size(), all, what);
        part.show(0, 1, "");
        return part;
    };
    for (const synthetic::Scene scene : request.scenes)
        out.push_back(ofScene(request, scene, factory, next(synthetic::name(scene))));
    for (std::size_t i = 0; i < labels.size(); ++i)
        out.push_back(
            ofRecording(request, request.recordings[i], labels[i], factory, next(labels[i])));
    return out;
}

}  // namespace mfar::eval
