#include "tests/measure/eval/picture_metrics_option.h"

#include "daemon/number_range.h"

#include <fmt/format.h>

#include <string>

namespace mfar::eval {
const char* const kPictureMetricsHelp =
    "msssim: multi-scale SSIM of five scales. lpc_si: sharpness by local phase coherence\n"
    "(Hassen et al. 2013), as in release 1.0. Few very sharp pixels determine it; lpc_si_tiles\n"
    "adds its quantiles over 8 x 8 equal parts of the picture.\n"
    "hdrvdp: hdrvdp_q is Q of HDR-VDP 2.2.1 and 2.2.2 (100: no difference, no lower bound);\n"
    "hdrvdp_qmos is Q_MOS of 2.2.0. Luma V is shown as black + (peak - black) (V/255)^gamma in\n"
    "a surround of 1e-5 cd/m2. Compare either value only between pictures of equal --ppd and\n"
    "equal size.";

void addMetricParameters(CLI::App& sub, PictureMetrics& metrics) {
    HdrVdpDisplay& display = metrics.display;
    sub.add_option("--ppd", display.pixelsPerDegree, "pixels per degree of the visual field")
        ->check(numberFrom(1, 1000))
        ->capture_default_str();
    sub.add_option("--peak", display.peak, "luminance of the display's white [cd/m2]")
        ->check(numberFrom(0.1, 10000))
        ->capture_default_str();
    sub.add_option("--black", display.black, "luminance of the display's black [cd/m2]")
        ->check(numberFrom(1e-4, 1000))
        ->capture_default_str();
    sub.add_option("--gamma", display.gamma, "gamma of the display")
        ->check(numberFrom(0.5, 4))
        ->capture_default_str();
    sub.add_option("--lpc-ratio", metrics.lpcRatio,
                   "bandwidth ratio of LPC-SI's filters; 0.75: the authors' release 1.0, 0.33: "
                   "another version in circulation")
        ->check(numberFrom(0.1, 0.95))
        ->capture_default_str();
}

void addPictureMetrics(CLI::App& sub, PictureMetrics& metrics) {
    sub.add_option(
           "--metrics", metrics.names,
           fmt::format("metrics to compute: any of {}", fmt::join(pictureMetricNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(pictureMetricNames()))
        ->option_text(fmt::format("NAMES (default: {})", fmt::join(metrics.names, ",")));
    addMetricParameters(sub, metrics);
}

}  // namespace mfar::eval
