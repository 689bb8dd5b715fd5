#include "tests/measure/bench/skips.h"

#include "tests/measure/bench/scene_frames.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/eval/metrics/depth_error.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/occlusion_score.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/scene_objects.h"
#include "tests/measure/eval/scene_run.h"
#include "tests/measure/eval/virtual_truth.h"

#include <GLES3/gl31.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace mfar::bench {
namespace {

using synthetic::Path;

/// Times and errors of the first frames do not count, because the first still must arrive and depth
/// must settle.
constexpr std::size_t kSettled = 8;
constexpr std::size_t kScoredFrames = 4;  // every fourth frame is scored
// Distance between two imagined cameras [m]. bad-1 of depth counts pixels whose disparity between
// these cameras is wrong by more than 1 px.
constexpr double kBaseline = 0.05;

struct Skip {
    const char* name;
    std::function<void(PipelineOptions&)> off;
};

Skip optional(const char* name, bool SkipOptions::* member) {
    return {name, [member](PipelineOptions& o) { o.skips.*member = false; }};
}

const std::vector<Skip>& allSkips() {
    static const std::vector<Skip> skips{
        {"unchanged-tiles", [](PipelineOptions& o) { o.skipUnchanged = false; }},
        optional("enlarged-tiles", &SkipOptions::enlargedTiles),
        optional("smooth-tiles", &SkipOptions::smoothTiles),
        optional("plain-tiles", &SkipOptions::plainTiles),
        optional("tile-lists", &SkipOptions::tileLists),
        optional("known-flow", &SkipOptions::knownFlow),
        {"predicted-lines", [](PipelineOptions& o) { o.epipolar.mostPredicted = 0; }},
        {"depth-near-objects", [](PipelineOptions& o) { o.depthEverywhere = true; }},
        {"depth-good-enough", [](PipelineOptions& o) { o.depth.enough = 0.001; }},
        optional("known-behind", &SkipOptions::knownBehind),
        optional("objects-at-rest", &SkipOptions::objectsAtRest),
        optional("hidden-objects", &SkipOptions::hiddenObjects),
        optional("object-bounds", &SkipOptions::objectBounds),
    };
    return skips;
}

struct Case {
    const char* name;
    synthetic::Scene scene;
    Path path;
    bool hasPoses;
    std::vector<VirtualObject> objects;
};

std::vector<VirtualObject> officeObject(const Eigen::Vector3d& by) {
    auto out = eval::sceneObjects(synthetic::Scene::Office);
    for (VirtualObject& object : out)
        object.T_world_object.translation += by;
    return out;
}

const std::vector<Case>& allCases() {
    static const std::vector<Case> cases{
        {"still", synthetic::Scene::Still, Path::Rest, true, {}},
        {"flat", synthetic::Scene::Flat, Path::Handheld, true, {}},
        {"office", synthetic::Scene::Office, Path::Handheld, true, officeObject({0, 0, 0})},
        {"office-rest", synthetic::Scene::Office, Path::Rest, true, officeObject({0, 0, 0})},
        {"moving", synthetic::Scene::Moving, Path::Handheld, true, {}},
        {"no-tag", synthetic::Scene::Office, Path::Handheld, false, officeObject({0, 0, 0})},
        {"out-of-view", synthetic::Scene::Office, Path::Handheld, true, officeObject({20, 0, 0})},
        {"hidden", synthetic::Scene::Office, Path::Handheld, true, officeObject({0, 0, -1.5})},
    };
    return cases;
}

template <class All>
auto chosen(const All& all, const std::vector<std::string>& names) {
    std::vector<typename All::value_type> out;
    for (const auto& one : all)
        if (names.empty() || std::ranges::find(names, one.name) != names.end()) out.push_back(one);
    return out;
}

struct Errors {
    double square = 0, overlap = 0, bad1 = 0;
    int frames = 0, seen = 0, depths = 0;

    [[nodiscard]] std::optional<double> psnr() const {
        if (frames == 0) return std::nullopt;
        return 10 * std::log10(255 * 255 / std::max(square / frames, 1e-9));
    }
    [[nodiscard]] std::optional<double> meanOverlap() const {
        return seen > 0 ? std::optional(100 * overlap / seen) : std::nullopt;
    }
    [[nodiscard]] std::optional<double> meanBad1() const {
        return depths > 0 ? std::optional(100 * bad1 / depths) : std::nullopt;
    }
};

std::optional<double> difference(std::optional<double> a, std::optional<double> b) {
    return a && b ? std::optional(*a - *b) : std::nullopt;
}

struct FrameTruth {
    cv::Mat luma;     ///< luma of the true picture; CV_64F at the output's size
    cv::Mat without;  ///< 255 where no object can be shown, else 0; CV_8U at the output's size
    cv::Mat visible;  ///< 255 where an object should be visible, else 0; CV_8U at the video's size
    cv::Mat silhouette, undecided, inverseDepth;
};

FrameTruth truthOf(SyntheticBoard& board, const Case& one, Timestamp time) {
    FrameTruth out;
    const StoredImage fine = board.highRes(time);
    const cv::Mat rgba(fine.size.height, fine.size.width, CV_8UC4,
                       const_cast<std::uint8_t*>(fine.pixels.data()));
    cv::Mat bgr;
    cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
    out.luma = eval::luma(bgr);
    FloatImage depth = board.inverseDepth(time);
    out.inverseDepth =
        cv::Mat(depth.size.height, depth.size.width, CV_32F, depth.values.data()).clone();
    const eval::VirtualTruth objects =
        eval::virtualTruth(one.objects, board.rig().video, board.pose(time).T_world_video, depth);
    out.visible = objects.visible;
    out.silhouette = objects.silhouette;
    out.undecided = objects.undecided;
    cv::Mat grown;
    cv::dilate(out.silhouette, grown, cv::Mat::ones(9, 9, CV_8U));
    cv::resize(grown, grown, out.luma.size(), 0, 0, cv::INTER_NEAREST);
    out.without = grown == 0;
    return out;
}

struct CaseFrame {
    SceneFrame shots;
    std::optional<FrameTruth> truth;
};

std::vector<CaseFrame> framesOf(const Case& one, eval::SceneRun& scene, int count) {
    std::vector<CaseFrame> out;
    for (std::size_t i = 0; i < kSettled + static_cast<std::size_t>(count); ++i) {
        CaseFrame frame{nextFrame(scene), {}};
        if (i == 0) scene.fire();
        if (i >= kSettled && i % kScoredFrames == 0)
            frame.truth = truthOf(scene.board(), one, frame.shots.time);
        out.push_back(std::move(frame));
    }
    return out;
}

class SkipWay {
public:
    SkipWay(const Case& one, const StereoRig& rig, const Skip* off, Clock clock)
        : case_(one), clock_(clock), focal_(rig.video.fx), pipeline_(rig, optionsWithout(off)) {
        pipeline_.setObjects(one.objects);
    }

    void run(const SceneFrame& frame, bool counts) {
        const auto pose = [&](const std::optional<Pose>& p) {
            return case_.hasPoses ? p : std::nullopt;
        };
        if (!frame.still.empty())
            pipeline_.setStill(eval::viewOf(frame.still), {}, pose(frame.stillPose));
        glFinish();
        const double ms = msOf(clock_, [&] {
            stats_ = pipeline_.run(eval::viewOf(frame.picture), frame.time, pose(frame.pose)).stats;
            glFinish();
        });
        if (!counts) return;
        ms_.push_back(ms);
        total_.depthTiles += stats_.depthTiles;
        total_.framesInView += stats_.objectsInView ? 1 : 0;
        total_.redrawn += pipeline_.readStats().redrawn;
    }

    void score(const FrameTruth& truth) {
        const cv::Mat picture =
            eval::luma(eval::fromRgba(pipeline_.readImage(), pipeline_.outputSize()));
        cv::Mat square;
        cv::multiply(picture - truth.luma, picture - truth.luma, square);
        errors_.square += cv::mean(square, truth.without)[0];
        ++errors_.frames;
        if (cv::countNonZero(truth.silhouette) == 0) return;
        const cv::Mat shown = eval::shownObjects(pipeline_);
        const Size video{truth.visible.cols, truth.visible.rows};
        const double overlap =
            eval::occlusionScore(eval::shownAtVideo(shown, video), truth.visible).overlap;
        if (std::isfinite(overlap)) {
            errors_.overlap += overlap;
            ++errors_.seen;
        }
        if (cv::countNonZero(truth.undecided) == 0) return;
        errors_.bad1 += depthBad1(truth);
        ++errors_.depths;
    }

    [[nodiscard]] double ms() const { return summarise(ms_).median; }
    [[nodiscard]] SkipCase summary() const {
        SkipCase out = total_;
        out.scene = case_.name;
        out.ms = ms();
        out.redrawn /= static_cast<double>(std::max<std::size_t>(ms_.size(), 1));
        return out;
    }
    [[nodiscard]] const Errors& errors() const { return errors_; }

private:
    [[nodiscard]] double depthBad1(const FrameTruth& truth) const {
        const InverseDepthField& field = pipeline_.inverseDepth();
        cv::Mat inverseDepth(truth.inverseDepth.size(), CV_32F, cv::Scalar(0));
        for (std::size_t i = 0; i < field.inverseDepth.size(); ++i)
            if (field.isKnown(i)) inverseDepth.ptr<float>()[i] = field.inverseDepth[i];
        return eval::depthError(inverseDepth, truth.inverseDepth, focal_ * kBaseline,
                                truth.undecided)
            .bad1;
    }

    static PipelineOptions optionsWithout(const Skip* off) {
        PipelineOptions out;
        if (off != nullptr) off->off(out);
        return out;
    }

    const Case& case_;
    Clock clock_;
    double focal_;
    Pipeline pipeline_;
    FrameStats stats_;
    SkipCase total_;
    std::vector<double> ms_;
    Errors errors_;
};

SkipResult resultOf(const SkipWay& usual, const SkipWay& without, const Skip& skip,
                    const Case& one) {
    SkipResult out{skip.name, one.name, usual.ms(), without.ms(), {}, {}, {}};
    const Errors &on = usual.errors(), &off = without.errors();
    out.psnrLost = difference(off.psnr(), on.psnr());
    out.bad1Added = difference(on.meanBad1(), off.meanBad1());
    out.overlapLost = difference(off.meanOverlap(), on.meanOverlap());
    return out;
}

void measureCase(const Case& one, const SkipRequest& request, SkipReport& report,
                 const ProgressPart& progress) {
    SyntheticOptions options;
    options.scene = one.scene;
    options.path = one.path;
    if (request.quick) options.rig = synthetic::boardRig(kQuickVideo, kQuickStill);
    const auto [rig, frames] = [&] {
        eval::SceneRun scene(options, eval::PoseSource::Recorded);
        return std::pair(scene.rig(), framesOf(one, scene, request.frames));
    }();
    const std::vector<Skip> skips = chosen(allSkips(), request.skips);
    std::vector<std::unique_ptr<SkipWay>> ways;
    ways.push_back(std::make_unique<SkipWay>(one, rig, nullptr, request.clock));
    for (const Skip& skip : skips)
        ways.push_back(std::make_unique<SkipWay>(one, rig, &skip, request.clock));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        progress.show(i, frames.size(), frameOf(i, frames.size()));
        for (const auto& way : ways) {
            way->run(frames[i].shots, i >= kSettled);
            if (frames[i].truth) way->score(*frames[i].truth);
        }
    }
    report.cases.push_back(ways[0]->summary());
    for (std::size_t i = 0; i < skips.size(); ++i)
        report.results.push_back(resultOf(*ways[0], *ways[i + 1], skips[i], one));
}

}  // namespace

std::vector<std::string> skipNames() {
    std::vector<std::string> out;
    for (const Skip& skip : allSkips())
        out.emplace_back(skip.name);
    return out;
}

std::vector<std::string> skipCaseNames() {
    std::vector<std::string> out;
    for (const Case& one : allCases())
        out.emplace_back(one.name);
    return out;
}

SkipReport measureSkips(const SkipRequest& request) {
    SkipReport out;
    const auto cases = chosen(allCases(), request.cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const ProgressPart progress = request.progress.part(i, cases.size(), cases[i].name);
        progress.show(0, 1, "");
        measureCase(cases[i], request, out, progress);
    }
    return out;
}

}  // namespace mfar::bench
