#include "tests/measure/eval/picture_metrics.h"

#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/metrics/ssim.h"

#include <fmt/format.h>

#include <algorithm>

namespace mfar::eval {
namespace {

void requireSide(const cv::Mat& picture, const char* metric, int side) {
    if (std::min(picture.cols, picture.rows) < side)
        throw EvalError(fmt::format("{} needs pictures of {}x{} pixels at least, not {}x{}", metric,
                                    side, side, picture.cols, picture.rows));
}

}  // namespace

const std::vector<std::string>& pictureMetricNames() {
    static const std::vector<std::string> names{"psnr",   "ssim",         "msssim",
                                                "lpc_si", "lpc_si_tiles", "hdrvdp"};
    return names;
}

bool PictureMetrics::has(const std::string& name) const {
    return std::find(names.begin(), names.end(), name) != names.end();
}

PictureScores scoreOf(const cv::Mat& picture, const cv::Mat& truth, const PictureMetrics& metrics) {
    requireSide(picture, "every metric", 17);
    PictureScores out;
    if (metrics.has("psnr")) out.psnr = psnr(picture, truth);
    if (metrics.has("ssim")) out.ssim = ssim(picture, truth);
    if (metrics.has("msssim")) {
        requireSide(picture, "msssim", kMsSsimSmallestSide);
        out.msSsim = msSsim(picture, truth);
    }
    if (metrics.has("lpc_si")) {
        requireSide(picture, "lpc_si", kLpcSmallestSide);
        out.lpcSi = lpcSi(picture, metrics.lpcRatio);
    }
    if (metrics.has("lpc_si_tiles")) {
        requireSide(picture, "lpc_si_tiles", kLpcTiles * kLpcSmallestSide);
        out.tiles = lpcTiles(picture, metrics.lpcRatio);
    }
    if (metrics.has("hdrvdp")) {
        const HdrVdpResult result =
            hdrVdp(displayedLight(picture, metrics.display), displayedLight(truth, metrics.display),
                   metrics.display.pixelsPerDegree);
        out.hdrVdpQ = result.q;
        out.hdrVdpQMos = result.qMos;
    }
    return out;
}

std::vector<Column> furtherColumns(const PictureMetrics& metrics) {
    std::vector<Column> out;
    if (metrics.has("msssim")) out.push_back({"msssim", 4});
    if (metrics.has("lpc_si_tiles"))
        out.insert(out.end(), {{"lpc_si_p10", 4}, {"lpc_si_median", 4}, {"lpc_si_p90", 4}});
    if (metrics.has("lpc_si") || metrics.has("lpc_si_tiles")) out.push_back({"lpc_ratio", 2});
    if (metrics.has("hdrvdp"))
        out.insert(out.end(), {{"hdrvdp_qmos", 2},
                               {"hdrvdp_ppd", 1},
                               {"hdrvdp_peak", 0},
                               {"hdrvdp_black", 2},
                               {"hdrvdp_gamma", 1}});
    return out;
}

std::vector<std::optional<double>> furtherValues(const PictureScores& scores,
                                                 const PictureMetrics& metrics) {
    std::vector<std::optional<double>> out;
    if (scores.msSsim) out.push_back(scores.msSsim);
    if (scores.tiles)
        out.insert(out.end(), {scores.tiles->p10, scores.tiles->median, scores.tiles->p90});
    if (scores.lpcSi || scores.tiles) out.emplace_back(metrics.lpcRatio);
    if (scores.hdrVdpQ) {
        const HdrVdpDisplay& seen = metrics.display;
        out.insert(out.end(),
                   {scores.hdrVdpQMos, seen.pixelsPerDegree, seen.peak, seen.black, seen.gamma});
    }
    return out;
}

}  // namespace mfar::eval
