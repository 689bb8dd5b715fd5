#pragma once

#include "base/image_view.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mfar::eval {

/// Loads an 8-bit colour picture as CV_8UC3 in OpenCV's order B G R. Throws ImageFileError.
[[nodiscard]] cv::Mat loadPicture(const std::filesystem::path& file);
/// Writes a PNG. Throws ImageFileError.
void savePicture(const std::filesystem::path& file, const cv::Mat& picture);

/// Converts CV_8UC3 B G R to the pipeline's format, CV_8UC4 R G B A.
[[nodiscard]] cv::Mat toRgba(const cv::Mat& bgr);
[[nodiscard]] ImageView viewOf(const cv::Mat& picture);
/// Converts the result of Pipeline::readImage() to CV_8UC3 B G R.
[[nodiscard]] cv::Mat fromRgba(const std::vector<std::uint8_t>& rgba, Size size);

}  // namespace mfar::eval
