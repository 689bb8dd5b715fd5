#pragma once

#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// Names that the option --metrics accepts: psnr, ssim, msssim, lpc_si, lpc_si_tiles, hdrvdp.
[[nodiscard]] const std::vector<std::string>& pictureMetricNames();

/// The requested metrics and their parameters.
struct PictureMetrics {
    std::vector<std::string> names;  ///< names out of pictureMetricNames()
    HdrVdpDisplay display;
    double lpcRatio = kLpcRelease;

    [[nodiscard]] bool has(const std::string& name) const;
};

/// Scores of one picture. A metric that is not requested is empty. The names are those of the
/// report's columns.
struct PictureScores {
    std::optional<double> psnr, ssim, msSsim, lpcSi, hdrVdpQ, hdrVdpQMos;
    std::optional<LpcTiles> tiles;
};

/// Both CV_64F in grey levels, same size. Throws EvalError for pictures that are too small for a
/// metric.
[[nodiscard]] PictureScores scoreOf(const cv::Mat& picture, const cv::Mat& truth,
                                    const PictureMetrics& metrics);

/// Columns of a report that follow psnr_db, ssim, lpc_si and hdrvdp_q, with the parameters of the
/// metrics. Only requested metrics have columns.
[[nodiscard]] std::vector<Column> furtherColumns(const PictureMetrics& metrics);
[[nodiscard]] std::vector<std::optional<double>> furtherValues(const PictureScores& scores,
                                                               const PictureMetrics& metrics);

/// Joins two lists: a report's own columns or values, and those of the metrics.
template <class T>
[[nodiscard]] std::vector<T> followedBy(std::vector<T> own, const std::vector<T>& others) {
    own.insert(own.end(), others.begin(), others.end());
    return own;
}

}  // namespace mfar::eval
