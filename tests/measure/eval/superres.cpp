#include "tests/measure/eval/superres.h"

#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/match_classes.h"
#include "tests/measure/eval/metrics/flicker.h"
#include "tests/measure/eval/metrics/harm_rate.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/tiles_below.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/superres_learning.h"
#include "tests/measure/eval/superres_methods.h"
#include "tests/measure/eval/superres_samples.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <optional>
#include <utility>

namespace mfar::eval {
namespace {

/// PSNR over the three 8-bit channels [dB]. Infinite for equal pictures; cv::PSNR gives 361 dB.
double colourPsnr(const cv::Mat& picture, const cv::Mat& truth) {
    const double values = 3 * static_cast<double>(picture.total());
    const double squares = cv::norm(picture, withoutBorder(truth), cv::NORM_L2SQR);
    return 10 * std::log10(255.0 * 255 * values / squares);
}

/// NaN means that nothing could be measured; the result is then empty.
std::optional<double> measured(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

class SuperResRun {
public:
    SuperResRun(const SuperResRequest& request, const Recording& recording, std::string label,
                SuperResFactory& factory)
        : request_(request), recording_(recording), poses_(recording, request.poses),
          label_(std::move(label)) {
        for (const std::string& name : request.methods)
            methods_.push_back({name, factory.create(name, recording.rig)});
        for (const std::filesystem::path& file : request.dnnModels)
            methods_.push_back({file.stem().string(), factory.createModel(file, recording.rig)});
        if (request.classes) matcher_ = factory.createMatcher(recording.rig);
    }

    void measure(const SuperResSample& sample, Report& report) {
        const Shot frame = loadFrame(sample);
        const cv::Mat truthPicture = loadHighRes(sample, recording_.rig);
        const cv::Mat truth = luma(withoutBorder(truthPicture));
        cv::Mat bicubicPicture;
        cv::resize(frame.picture, bicubicPicture, truthPicture.size(), 0, 0, cv::INTER_CUBIC);
        const cv::Mat bicubic = luma(withoutBorder(bicubicPicture));
        if (!request_.noStill) setStills(sample);
        const cv::Mat classes = matcher_ ? matchClasses(recording_.rig, outputSize(recording_.rig),
                                                        matcher_->run(frame))
                                         : cv::Mat();
        const std::string name = std::to_string(sample.video.time.ns);
        save(name, "truth", truthPicture);
        const cv::Mat flow = flowTo(sample.video.time);
        for (Named& method : methods_) {
            const auto result = method.method->run(frame);
            CV_Assert(result.picture.size() == truthPicture.size());
            const cv::Mat picture = luma(withoutBorder(result.picture));
            const PictureScores scores = scoreOf(picture, truth, request_.metrics);
            auto values = followedBy({result.ms, scores.psnr, scores.ssim, scores.lpcSi,
                                      scores.hdrVdpQ, harmRate(picture, bicubic, truth)},
                                     furtherValues(scores, request_.metrics));
            values.emplace_back(colourPsnr(withoutBorder(result.picture), truthPicture));
            values.push_back(measured(tilesBelow(picture, bicubic, truth)));
            cv::Mat error = picture - truth;
            values.push_back(flow.empty()
                                 ? std::nullopt
                                 : measured(flicker(method.error, error, flow, kSuperResBorder)));
            method.error = std::move(error);
            if (matcher_)
                values = followedBy(
                    values, matchClassValues(withoutBorder(classes), picture, bicubic, truth));
            report.add(label_, name, method.name, values);
            save(name, method.name, result.picture);
        }
    }

private:
    struct Named {
        std::string name;
        std::unique_ptr<SuperResMethod> method;
        cv::Mat error{};
    };
    using Times = std::pair<Timestamp, Timestamp>;

    [[nodiscard]] cv::Mat flowTo(Timestamp time) {
        const auto last = std::exchange(frameTime_, time);
        const auto file = last ? recording_.truthFlow(*last, time) : std::nullopt;
        if (!file) return {};
        FlowImage flow = loadFlo(*file);
        return cv::Mat(flow.size.height, flow.size.width, CV_32FC2, flow.vectors.data()).clone();
    }
    [[nodiscard]] Shot loadFrame(const SuperResSample& sample) const {
        const Timestamp time = sample.video.time;
        const cv::Mat picture = degrade(loadPicture(sample.video.file), request_.videoDegradation,
                                        ~static_cast<std::uint64_t>(time.ns));
        Shot out{picture, time, poses_.of(time, sample.still.time).frame};
        if (out.pose) out.pose = turned(*out.pose, request_.poseNoise, label_);
        return out;
    }

    [[nodiscard]] Shot loadStill(const RecordedImage& still, Timestamp frame) const {
        return {degrade(loadPicture(still.file), request_.degradation,
                        static_cast<std::uint64_t>(still.time.ns)),
                still.time, poses_.of(frame, still.time).still};
    }

    void setStills(const SuperResSample& sample) {
        const bool both = request_.stills > 1 && sample.second;
        const Times times{sample.still.time, both ? sample.second->time : Timestamp{}};
        if (times == stillTimes_) return;
        const Shot newest = loadStill(sample.still, sample.video.time);
        std::optional<Shot> second;
        if (both) second = loadStill(*sample.second, sample.video.time);
        for (const Named& method : methods_)
            method.method->setStills(newest, second ? &*second : nullptr);
        if (matcher_) matcher_->setStill(newest);
        stillTimes_ = times;
    }

    void save(const std::string& frame, const std::string& name, const cv::Mat& picture) const {
        if (request_.save.empty()) return;
        std::string folder = label_;
        for (char& c : folder)
            if (c == '/') c = '_';
        const auto dir = request_.save / folder;
        std::error_code error;
        std::filesystem::create_directories(dir, error);
        savePicture(dir / fmt::format("{}_{}.png", frame, name), picture);
    }

    const SuperResRequest& request_;
    const Recording& recording_;
    KnownPoses poses_;
    std::string label_;
    std::vector<Named> methods_;
    std::unique_ptr<StillMatcher> matcher_;
    std::optional<Times> stillTimes_;
    std::optional<Timestamp> frameTime_;
};

}  // namespace

Report evaluateSuperRes(const SuperResRequest& request) {
    auto columns = followedBy<Column>(
        {{"ms", 1}, {"psnr_db", 2}, {"ssim", 4}, {"lpc_si", 4}, {"hdrvdp_q", 2}, {"harm_rate", 4}},
        furtherColumns(request.metrics));
    columns.push_back({"psnr_rgb_db", 2});
    columns.push_back({"tiles_below", 4});
    columns.push_back({"flicker", 2});
    if (request.classes) columns = followedBy(columns, matchClassColumns());
    Report report(columns);
    if (request.classes) report.setHead(matchClassesHead());
    const auto labels = labelsOf(request.recordings);
    SuperResFactory factory(request.alpha);
    if (request.learn != 0) factory.requireContext();
    const bool learnsElsewhere = request.learn != 0 && !request.learnFrom.empty();
    if (learnsElsewhere) factory.setFilters(learnedFilters(request, request.learnFrom));
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const ProgressPart progress = request.progress.part(i, labels.size(), labels[i]);
        progress.show(0, 1, request.learn != 0 ? "learning" : "");
        if (request.learn != 0 && !learnsElsewhere)
            factory.setFilters(learnedFilters(request, {request.recordings[i]}));
        const Recording recording = loadRecording(request.recordings[i]);
        const auto samples = superResSamplesOf(recording, request.frames, !request.noStill);
        SuperResRun run(request, recording, labels[i], factory);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            progress.show(k, samples.size(), frameOf(k, samples.size()));
            run.measure(samples[k], report);
        }
    }
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
