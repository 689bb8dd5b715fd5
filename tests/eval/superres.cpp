#include "tests/eval/superres.h"

#include "hal/virtual/recording.h"
#include "tests/eval/labels.h"
#include "tests/eval/metrics/harm_rate.h"
#include "tests/eval/metrics/luma.h"
#include "tests/eval/metrics/psnr.h"
#include "tests/eval/metrics/ssim.h"
#include "tests/eval/picture.h"
#include "tests/eval/rig_resample.h"
#include "tests/eval/still_choice.h"
#include "tests/eval/superres_methods.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <cstdio>

namespace mfar::eval {
namespace {

/// A frame to measure on: its truth and the still it may use.
struct Sample {
    RecordedImage video;
    RecordedImage still;
    std::filesystem::path truth;
};

std::vector<Sample> samplesOf(const Recording& recording, int limit) {
    std::vector<Sample> out;
    bool anyTruth = false;
    for (const RecordedImage& video : recording.video) {
        if (limit > 0 && static_cast<int>(out.size()) == limit) break;
        const auto truth = recording.truthHighRes(video.time);
        if (!truth) continue;
        anyTruth = true;
        const auto still = referenceStill(recording, video.time);
        if (still)
            out.push_back({video, recording.stills[*still], *truth});
        else
            fmt::print(stderr, "mfar-eval: {}: no other still for frame {}, left out\n",
                       recording.root.string(), video.time.ns);
    }
    if (!anyTruth)
        throw EvalError(fmt::format("{}: no truth: truth/highres has no picture of a video frame",
                                    recording.root.string()));
    if (out.empty())
        throw EvalError(fmt::format("{}: no frame has a still that may be its reference",
                                    recording.root.string()));
    return out;
}

cv::Mat withoutBorder(const cv::Mat& picture) {
    const int b = kSuperResBorder;
    return picture(cv::Rect(b, b, picture.cols - 2 * b, picture.rows - 2 * b));
}

cv::Mat loadTruth(const Sample& sample, const StereoRig& rig) {
    cv::Mat truth = loadPicture(sample.truth);
    const Size wanted = outputSize(rig);
    if (truth.cols != wanted.width || truth.rows != wanted.height)
        throw EvalError(fmt::format("{}: truth has {}x{} pixels, the output {}x{}",
                                    sample.truth.string(), truth.cols, truth.rows, wanted.width,
                                    wanted.height));
    if (truth.cols < 2 * kSuperResBorder + 11 || truth.rows < 2 * kSuperResBorder + 11)
        throw EvalError(fmt::format("{}: too small to leave {} px borders out",
                                    sample.truth.string(), kSuperResBorder));
    return truth;
}

/// One recording with the methods set up for its rig.
class RecordingRun {
public:
    RecordingRun(const SuperResRequest& request, const Recording& recording, std::string label,
                 SuperResFactory& factory)
        : request_(request), recording_(recording), poses_(recording, request.poses),
          label_(std::move(label)) {
        for (const std::string& name : request.methods)
            methods_.push_back(factory.create(name, recording.rig));
    }

    void measure(const Sample& sample, Report& report) {
        const Shot frame = loadFrame(sample);
        const cv::Mat truthPicture = loadTruth(sample, recording_.rig);
        const cv::Mat truth = luma(withoutBorder(truthPicture));
        cv::Mat bicubicPicture;
        cv::resize(frame.picture, bicubicPicture, truthPicture.size(), 0, 0, cv::INTER_CUBIC);
        const cv::Mat bicubic = luma(withoutBorder(bicubicPicture));
        setStill(sample);
        const std::string name = std::to_string(sample.video.time.ns);
        save(name, "truth", truthPicture);
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            const auto result = methods_[i]->run(frame);
            CV_Assert(result.picture.size() == truthPicture.size());
            const cv::Mat picture = luma(withoutBorder(result.picture));
            report.add(label_, name, request_.methods[i],
                       {result.ms, psnr(picture, truth), ssim(picture, truth), std::nullopt,
                        std::nullopt, harmRate(picture, bicubic, truth)});
            save(name, request_.methods[i], result.picture);
        }
    }

private:
    [[nodiscard]] Shot loadFrame(const Sample& sample) const {
        const Timestamp time = sample.video.time;
        Shot out{loadPicture(sample.video.file), time, poses_.of(time, sample.still.time).frame};
        if (out.pose) out.pose = turned(*out.pose, request_.poseNoise, label_);
        return out;
    }

    void setStill(const Sample& sample) {
        const Timestamp time = sample.still.time;
        if (time == stillTime_) return;
        const cv::Mat picture = degrade(loadPicture(sample.still.file), request_.degradation,
                                        static_cast<std::uint64_t>(time.ns));
        const Shot still{picture, time, poses_.of(sample.video.time, time).still};
        for (const auto& method : methods_)
            method->setStill(still);
        stillTime_ = time;
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
    std::vector<std::unique_ptr<SuperResMethod>> methods_;
    std::optional<Timestamp> stillTime_;
};

}  // namespace

Report evaluateSuperRes(const SuperResRequest& request) {
    Report report(
        {{"ms", 1}, {"psnr_db", 2}, {"ssim", 4}, {"lpc_si", 4}, {"hdrvdp_q", 2}, {"harm_rate", 4}});
    const auto labels = labelsOf(request.recordings);
    SuperResFactory factory(request.alpha);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Recording recording = loadRecording(request.recordings[i]);
        const auto samples = samplesOf(recording, request.frames);
        RecordingRun run(request, recording, labels[i], factory);
        for (const Sample& sample : samples)
            run.measure(sample, report);
    }
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
