#pragma once

#include "hal/virtual/recording.h"
#include "pipeline/results.h"

#include <opencv2/core.hpp>

#include <array>
#include <functional>
#include <vector>

namespace mfar::demo {

/// Means over the frames that have a true picture. Errors are those of luma, without a border of
/// 32 px.
struct Quality {
    int frames = 0;
    double upscaledPsnrDb = 0;
    double resultPsnrDb = 0;
    double upscaledSsim = 0;
    double resultSsim = 0;
    double harmRate = 0;        ///< share of pixels > 2 grey levels worse than enlarged video
    double meanConfidence = 0;  ///< mean of eq. 2 of the paper, [0, 1]
    double frameMs = 0;         ///< time of the whole pipeline until all work is finished
    std::array<double, kTileClasses> tileShares{};
};

/// One frame, with all data that the demonstration's pictures show. Pictures are CV_8UC3, B G R, at
/// output size.
struct Shown {
    cv::Mat upscaled;
    cv::Mat result;
    cv::Mat truth;
    std::vector<float> confidence;   ///< confidence of each video pixel
    std::vector<TileClass> classes;  ///< class of each tile
    Size video;
};

struct DemoRun {
    Quality quality;
    Shown last;  ///< the last frame that has a true picture
};

/// Runs the pipeline over the frames, each with the newest still that was taken before it.
/// `progress` gets the number of frames done and the total. Needs a current GL context. Throws
/// std::runtime_error if no frame of the recording has a true picture.
[[nodiscard]] DemoRun runDemo(const Recording& recording,
                              const std::function<void(int, int)>& progress);

}  // namespace mfar::demo
