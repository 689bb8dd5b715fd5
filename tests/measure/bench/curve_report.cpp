#include "tests/measure/bench/curve_report.h"

#include "tests/measure/eval/report.h"

#include <fmt/format.h>

namespace mfar::bench {
namespace {

namespace fs = std::filesystem;

std::string measured(const CurvePoint& p) {
    return fmt::format("{:.3f},{:.4f},{:.6f}\n", p.ms, p.epe, p.bad1);
}

}  // namespace

std::string curvesCsv(const Curves& curves) {
    std::string out = "method,knob,value,default,ms,epe_px,bad1\n";
    for (const Curve& curve : curves.curves)
        for (const CurvePoint& p : curve.points)
            out += fmt::format("{},{},{:g},{},", curve.method, curve.knob, p.value,
                               p.isDefault ? 1 : 0) +
                   measured(p);
    for (const CurvePeer& peer : curves.peers)
        out += fmt::format("{},,,,", peer.name) + measured(peer.point);
    return out;
}

void writeCurves(const Curves& curves, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);  // writeText() reports a missing folder
    eval::writeText(folder / "curves.csv", curvesCsv(curves));
    eval::writeText(folder / "curves.svg", curvesSvg(curves));
}

}  // namespace mfar::bench
