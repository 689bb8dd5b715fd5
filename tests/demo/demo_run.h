#pragma once

#include "hal/virtual/recording.h"
#include "pipeline/results.h"

#include <opencv2/core.hpp>

#include <array>
#include <functional>
#include <vector>

namespace mfar::demo {

/// Means over the frames that have a truth: of luma, without a border of 32 px.
struct Quality {
    int frames = 0;
    double upscaledPsnrDb = 0;
    double resultPsnrDb = 0;
    double upscaledSsim = 0;
    double resultSsim = 0;
    double harmRate = 0;        ///< share of pixels worse than upscaling by over 2 grey levels
    double meanConfidence = 0;  ///< eq. 2, [0, 1]
    double frameMs = 0;         ///< of the whole pipeline, work finished
    std::array<double, kTileClasses> tileShares{};
};

/// One frame with everything the pictures show. Pictures are CV_8UC3, B G R, at output size.
struct Shown {
    cv::Mat upscaled;
    cv::Mat result;
    cv::Mat truth;
    std::vector<float> confidence;   ///< per video pixel
    std::vector<TileClass> classes;  ///< per tile
    Size video;
};

struct DemoRun {
    Quality quality;
    Shown last;  ///< the last frame with a truth
};

/// Runs the pipeline over the frames, each with the newest still taken before it. Needs a current
/// GL context. `progress` gets the frames done and in total. Throws std::runtime_error when
/// the recording has no frame with a truth.
[[nodiscard]] DemoRun runDemo(const Recording& recording,
                              const std::function<void(int, int)>& progress);

}  // namespace mfar::demo
