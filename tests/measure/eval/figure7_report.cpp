#include "tests/measure/eval/figure7_report.h"

#include <fmt/format.h>

#include <optional>

namespace mfar::eval {

const std::vector<Figure7Method>& figure7Methods() {
    static const std::vector<Figure7Method> methods{
        {"truth", "ground truth"},
        {"detail", "mfar"},
        {"blend", "the paper's blending on mfar's flow"},
        {"paper", "the paper's method (OpenCV DIS)"},
        {"bicubic", "bicubic"},
        {"bilinear", "bilinear"}};
    return methods;
}

Report figure7Report(const std::vector<Figure7Scene>& scenes, const PictureMetrics& metrics) {
    Report report(followedBy<Column>({{"psnr_db", 2}, {"hdrvdp_q", 2}, {"lpc_si", 4}},
                                     furtherColumns(metrics)));
    for (const Figure7Scene& scene : scenes)
        for (std::size_t f = 0; f < scene.frames.size(); ++f)
            for (std::size_t m = 0; m < scene.scores.size(); ++m) {
                const PictureScores& s = scene.scores[m][f];
                // The truth (method 0) has an infinite PSNR, which is left out.
                const auto decibels = m == 0 ? std::nullopt : s.psnr;
                report.add(scene.name, scene.frames[f], figure7Methods()[m].name,
                           followedBy({decibels, s.hdrVdpQ, s.lpcSi}, furtherValues(s, metrics)));
            }
    report.addMeans();
    return report;
}

std::string figure7Summary(const std::vector<Figure7Scene>& scenes) {
    std::string out;
    for (const Figure7Scene& scene : scenes) {
        const auto q = [&](std::size_t method) {
            return scene.mean(method, [](const PictureScores& s) { return *s.hdrVdpQ; });
        };
        const auto sharpness = [&](std::size_t method) {
            return scene.mean(method, [](const PictureScores& s) { return *s.lpcSi; });
        };
        out += fmt::format("{}: HDR-VDP-2 Q {:.2f} ({:+.2f} over the paper's method, {:+.2f} over "
                           "the paper's blending on mfar's flow, {:+.2f} over bilinear); LPC-SI "
                           "{:.4f} ({:+.4f} from the truth's)\n",
                           scene.name, q(1), q(1) - q(3), q(1) - q(2), q(1) - q(5), sharpness(1),
                           sharpness(1) - sharpness(0));
    }
    return out;
}

}  // namespace mfar::eval
