#include "tests/measure/eval/superres_samples.h"

#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/still_choice.h"

#include <fmt/format.h>

#include <cstdio>

namespace mfar::eval {

std::vector<SuperResSample> superResSamplesOf(const Recording& recording, int limit,
                                              bool needsStill) {
    std::vector<SuperResSample> out;
    bool anyTruth = false;
    for (const RecordedImage& video : recording.video) {
        if (limit > 0 && static_cast<int>(out.size()) == limit) break;
        const auto truth = recording.truthHighRes(video.time);
        if (!truth) continue;
        anyTruth = true;
        const auto still = referenceStill(recording, video.time);
        if (!still && needsStill) {
            fmt::print(
                stderr,
                "mfar-eval: {}: frame {} is skipped: every still was taken from the same pose as "
                "the frame, or the recording has no stills\n",
                recording.root.string(), video.time.ns);
            continue;
        }
        out.push_back({video, still ? recording.stills[*still] : video, {}, *truth});
        if (const auto second = secondStill(recording, video.time))
            out.back().second = recording.stills[*second];
    }
    if (!anyTruth)
        throw EvalError(fmt::format("{}: no truth: truth/highres has no picture of a video frame; "
                                    "mfar-sim makes recordings with truth",
                                    recording.root.string()));
    if (out.empty())
        throw EvalError(
            fmt::format("{}: no frame can be evaluated: every still was taken from the same pose "
                        "as the frame, or the recording has no stills",
                        recording.root.string()));
    return out;
}

cv::Mat withoutBorder(const cv::Mat& picture) {
    const int b = kSuperResBorder;
    return picture(cv::Rect(b, b, picture.cols - 2 * b, picture.rows - 2 * b));
}

cv::Mat loadHighRes(const SuperResSample& sample, const StereoRig& rig) {
    cv::Mat truth = loadPicture(sample.truth);
    const Size wanted = outputSize(rig);
    if (truth.cols != wanted.width || truth.rows != wanted.height)
        throw EvalError(fmt::format(
            "{}: the true picture has {}x{} pixels, but the output has {}x{}",
            sample.truth.string(), truth.cols, truth.rows, wanted.width, wanted.height));
    if (truth.cols < 2 * kSuperResBorder + 11 || truth.rows < 2 * kSuperResBorder + 11)
        throw EvalError(
            fmt::format("{}: the picture is too small, because a border of {} px is left out",
                        sample.truth.string(), kSuperResBorder));
    return truth;
}

}  // namespace mfar::eval
