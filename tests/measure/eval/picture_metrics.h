#pragma once

#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// Names that `--metrics` accepts: psnr, ssim, msssim, lpc_si, lpc_si_tiles, hdrvdp.
[[nodiscard]] const std::vector<std::string>& pictureMetricNames();

/// The requested metrics and their parameters.
struct PictureMetrics {
    std::vector<std::string> names;  ///< of pictureMetricNames()
    HdrVdpDisplay display;
    double lpcRatio = kLpcRelease;

    [[nodiscard]] bool has(const std::string& name) const;
};

/// Empty for metrics that are not requested. Names as in design.md, section 10.
struct PictureScores {
    std::optional<double> psnr, ssim, msSsim, lpcSi, hdrVdpQ, hdrVdpQMos;
    std::optional<LpcTiles> tiles;
};

/// Both CV_64F in grey levels, same size. Throws EvalError for pictures that are too small for a
/// metric.
[[nodiscard]] PictureScores scoreOf(const cv::Mat& picture, const cv::Mat& truth,
                                    const PictureMetrics& metrics);

/// Further columns of a report, after psnr_db, ssim, lpc_si and hdrvdp_q, with the parameters of
/// the metrics; none for metrics that are not requested.
[[nodiscard]] std::vector<Column> furtherColumns(const PictureMetrics& metrics);
[[nodiscard]] std::vector<std::optional<double>> furtherValues(const PictureScores& scores,
                                                               const PictureMetrics& metrics);

/// Concatenates a report's own columns or values and others.
template <class T>
[[nodiscard]] std::vector<T> followedBy(std::vector<T> own, const std::vector<T>& others) {
    own.insert(own.end(), others.begin(), others.end());
    return own;
}

}  // namespace mfar::eval
