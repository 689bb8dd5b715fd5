#pragma once

#include "hal/virtual/recording.h"
#include "pipeline/engine/engine.h"
#include "pipeline/results.h"

#include <opencv2/core.hpp>

#include <array>
#include <functional>
#include <vector>

namespace mfar::demo {

/// Means over the frames that have a still and a true picture. The luma is compared, without a
/// border of 32 px.
struct Quality {
    int frames = 0;
    double enlargedPsnrDb = 0;
    double resultPsnrDb = 0;
    double enlargedSsim = 0;
    double resultSsim = 0;
    /// Share of the pixels at which the result's error exceeds the error of the enlarged video by
    /// more than 2 grey levels.
    double harmRate = 0;
    double meanConfidence = 0;  ///< [0, 1]
    double frameMs = 0;         ///< time of a frame until the pipeline has finished all work
    std::array<double, kTileClasses> tileShares{};
};

/// Data of one frame for the demonstration's pictures. Pictures are CV_8UC3, B G R, at output size.
struct Shown {
    cv::Mat enlarged;
    cv::Mat result;
    cv::Mat truth;
    std::vector<float> confidence;
    std::vector<TileClass> classes;
    Size video;
};

struct DemoRun {
    Quality quality;
    Shown last;
};

/// Runs the pipeline on all frames, with all steps on `engine`. Each frame is matched with the
/// newest still taken before it. `progress` gets the number of processed frames and of all frames.
/// Needs a current GL context for EngineKind::Gles.
/// Throws std::runtime_error if no frame of the recording has both a still and a true picture.
[[nodiscard]] DemoRun runDemo(const Recording& recording, EngineKind engine,
                              const std::function<void(int, int)>& progress);

}  // namespace mfar::demo
