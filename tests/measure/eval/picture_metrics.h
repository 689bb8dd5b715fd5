#pragma once

#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

[[nodiscard]] const std::vector<std::string>& pictureMetricNames();

struct PictureMetrics {
    std::vector<std::string> names;
    HdrVdpDisplay display;
    double lpcRatio = kLpcRelease;

    [[nodiscard]] bool has(const std::string& name) const;
};

/// Scores of one picture. Metrics that are not requested are empty.
struct PictureScores {
    std::optional<double> psnr, ssim, msSsim, lpcSi, hdrVdpQ, hdrVdpQMos;
    std::optional<LpcTiles> tiles;
};

/// Compares the luma of two pictures, CV_64F in grey levels, of the same size. Throws EvalError if
/// the pictures are too small for a requested metric.
[[nodiscard]] PictureScores scoreOf(const cv::Mat& picture, const cv::Mat& truth,
                                    const PictureMetrics& metrics);

/// Columns of a report that follow psnr_db, ssim, lpc_si and hdrvdp_q: further scores of the
/// requested metrics, and the parameters with which they were computed.
[[nodiscard]] std::vector<Column> furtherColumns(const PictureMetrics& metrics);
[[nodiscard]] std::vector<std::optional<double>> furtherValues(const PictureScores& scores,
                                                               const PictureMetrics& metrics);

template <class T>
[[nodiscard]] std::vector<T> followedBy(std::vector<T> own, const std::vector<T>& others) {
    own.insert(own.end(), others.begin(), others.end());
    return own;
}

}  // namespace mfar::eval
