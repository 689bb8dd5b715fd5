#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace mfar::eval {

/// What the name of a model of OpenCV's dnn_superres says, as in EDSR_x4.pb.
struct DnnModelName {
    std::string algorithm;  ///< edsr, espcn, fsrcnn, lapsrn
    int scale;              ///< 2, 3, 4, 8
};

/// Throws EvalError for other names.
[[nodiscard]] DnnModelName dnnModelNamed(const std::filesystem::path& file);

/// A peer for super-resolution without a still: such a model enlarges the video by its own factor,
/// what remains to the output's size is done by OpenCV (bicubic, area means where it shrinks).
/// B G R, CV_8UC3. Throws EvalError when the file cannot be used or when this program was built
/// without dnn_superres.
[[nodiscard]] std::function<cv::Mat(const cv::Mat&)> dnnEnlarger(const std::filesystem::path& file,
                                                                 Size output);

}  // namespace mfar::eval
