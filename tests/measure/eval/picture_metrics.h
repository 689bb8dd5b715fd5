#pragma once

#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/report.h"

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// What `--metrics` accepts: psnr, ssim, msssim, lpc_si, lpc_si_tiles, hdrvdp.
[[nodiscard]] const std::vector<std::string>& pictureMetricNames();

/// Which measures of pictures are wanted, and how they look at them.
struct PictureMetrics {
    std::vector<std::string> names;  ///< of pictureMetricNames()
    HdrVdpDisplay display;
    double lpcRatio = kLpcRelease;

    [[nodiscard]] bool has(const std::string& name) const;
};

/// Nothing where it is not wanted. Names as in design.md, section 10.
struct PictureScores {
    std::optional<double> psnr, ssim, msSsim, lpcSi, hdrVdpQ, hdrVdpQMos;
    std::optional<LpcTiles> tiles;
};

/// Both CV_64F in grey levels, same size. Throws EvalError for pictures too small for a measure.
[[nodiscard]] PictureScores scoreOf(const cv::Mat& picture, const cv::Mat& truth,
                                    const PictureMetrics& metrics);

/// What goes beside psnr_db, ssim, lpc_si and hdrvdp_q into a report, with the parameters of the
/// measures that have some; nothing for measures that are not wanted.
[[nodiscard]] std::vector<Column> furtherColumns(const PictureMetrics& metrics);
[[nodiscard]] std::vector<std::optional<double>> furtherValues(const PictureScores& scores,
                                                               const PictureMetrics& metrics);

/// A report's own columns or values and then others.
template <class T>
[[nodiscard]] std::vector<T> followedBy(std::vector<T> own, const std::vector<T>& others) {
    own.insert(own.end(), others.begin(), others.end());
    return own;
}

}  // namespace mfar::eval
