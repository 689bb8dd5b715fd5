#include "tests/measure/bench/curve_samples.h"

#include "hal/virtual/synthetic_board.h"
#include "tests/measure/bench/workload.h"
#include "tests/measure/eval/flow_samples.h"
#include "tests/measure/eval/labels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace mfar::bench {
namespace {

cv::Mat reduced(const FlowImage& flow, Size size) {
    const double scale = static_cast<double>(size.width) / flow.size.width;
    cv::Mat out(size.height, size.width, CV_32FC2);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int fromX = std::min(static_cast<int>((x + 0.5) / scale), flow.size.width - 1);
            const int fromY = std::min(static_cast<int>((y + 0.5) / scale), flow.size.height - 1);
            const auto& from =
                flow.vectors[static_cast<std::size_t>(fromY) * flow.size.width + fromX];
            out.at<cv::Vec2f>(y, x) = scale * cv::Vec2f(from[0], from[1]);
        }
    }
    return out;
}

}  // namespace

std::vector<CurveSample> curveSamplesOf(const std::vector<std::filesystem::path>& folders,
                                        std::size_t most) {
    std::vector<CurveSample> out;
    const auto labels = eval::labelsOf(folders);
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const eval::FlowSet set = eval::flowSamplesOf(folders[i]);
        for (std::size_t k = 0; k < std::min(most, set.samples.size()); ++k)
            out.push_back({labels[i], set.rig, eval::loadFrame(set, set.samples[k]),
                           eval::loadStill(set, set.samples[k]),
                           eval::loadTruth(set, set.samples[k])});
    }
    return out;
}

std::vector<CurveSample> syntheticCurveSamples(Size video, std::size_t most) {
    using View = SyntheticBoard::View;
    const Size still{video.width * 18 / 5, video.height * 18 / 5};
    std::vector<CurveSample> out;
    for (const synthetic::Scene scene : {synthetic::Scene::Office, synthetic::Scene::Shelf}) {
        if (out.size() == most) break;
        SyntheticBoard board(handheldOptions(scene, video, still));
        const Workload work = handheldWorkload(board, video, still, 3);
        const Pose &frame = *work.framePoses.back(), &reference = *work.stillPoses[0];
        out.push_back(
            {std::string(name(scene)),
             work.rig,
             {work.frames.back(), frame.time, frame},
             {work.stills[0], reference.time, reference},
             reduced(board.flow(View::Video, frame.time, View::StillAtVideo, reference.time),
                     video)});
    }
    return out;
}

}  // namespace mfar::bench
