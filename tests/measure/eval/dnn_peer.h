#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace mfar::eval {

/// Algorithm and factor in the file name of a dnn_superres model, for example EDSR_x4.pb.
struct DnnModelName {
    std::string algorithm;
    int scale;
};

/// Splits a file name like EDSR_x4.pb. Throws EvalError if the name does not have this form.
[[nodiscard]] DnnModelName dnnModelNamed(const std::filesystem::path& file);

/// Returns a function that enlarges video without a still. The model enlarges by its own factor;
/// OpenCV then resizes to the output's size (bicubic, or area means for shrinking). Pictures are
/// B G R, CV_8UC3. Throws EvalError if the file cannot be used or if dnn_superres is not built in.
[[nodiscard]] std::function<cv::Mat(const cv::Mat&)> dnnEnlarger(const std::filesystem::path& file,
                                                                 Size output);

}  // namespace mfar::eval
