#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace mfar::eval {

/// Information from the file name of an OpenCV dnn_superres model, such as EDSR_x4.pb.
struct DnnModelName {
    std::string algorithm;  ///< edsr, espcn, fsrcnn, lapsrn
    int scale;              ///< 2, 3, 4, 8
};

/// Throws EvalError for other names.
[[nodiscard]] DnnModelName dnnModelNamed(const std::filesystem::path& file);

/// A peer for super-resolution without a still: the model enlarges the video by its own factor;
/// OpenCV then resizes to the output's size (bicubic, area means for shrinking). B G R, CV_8UC3.
/// Throws EvalError if the file cannot be used or if this program was built without dnn_superres.
[[nodiscard]] std::function<cv::Mat(const cv::Mat&)> dnnEnlarger(const std::filesystem::path& file,
                                                                 Size output);

}  // namespace mfar::eval
