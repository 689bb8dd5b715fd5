#include "tests/engine/simd/detail_case.h"
#include "tests/measure/steps/cases.h"

namespace mfar {
namespace {

using simd::DetailCase;

constexpr Size kVideo{640, 480}, kStill{2304, 1728};

const DetailCase& frame(double changedShare) {
    static const DetailCase whole(kVideo, kStill), part(kVideo, kStill, 0.1);
    return changedShare < 1 ? part : whole;
}

struct Drawn {
    Drawn(Size output, const std::shared_ptr<Workers>& workers)
        : still(frame(1).rig, output, workers), step(still.rig(), output, workers), out(output) {
        still.set(frame(1).stillView());
    }
    simd::StillPreparation still;
    simd::DetailStep step;
    AlignedRows<std::uint32_t> out;
};

BenchCase drawing(const std::string& name, Size output, double share, bool usesStill,
                  SuperResMode mode) {
    return {name, [=](const std::shared_ptr<Workers>& workers) {
                return [=, drawn = std::make_shared<Drawn>(output, workers)] {
                    drawn->step.draw(frame(share).input(usesStill ? &drawn->still : nullptr),
                                     {mode, true, true, true}, drawn->out.rows());
                };
            }};
}

BenchCase preparing(const std::string& name, Size output, bool keepsPicture) {
    return {name, [=](const std::shared_ptr<Workers>& workers) {
                auto still =
                    std::make_shared<simd::StillPreparation>(frame(1).rig, output, workers);
                return [=] { still->set(frame(1).stillView(), {}, keepsPicture); };
            }};
}

}  // namespace

std::vector<BenchCase> detailBenchCases() {
    std::vector<BenchCase> out;
    for (const Size output : {Size{1280, 960}, Size{1920, 1440}, Size{2304, 1728}}) {
        const std::string to = " to " + std::to_string(output.width);
        out.push_back(preparing("still RGBA" + to, output, false));
        out.push_back(preparing("still RGBA with a copy of the picture" + to, output, true));
        using enum SuperResMode;
        out.push_back(drawing("detail, whole picture" + to, output, 1, true, Detail));
        out.push_back(drawing("detail, 10 % of the tiles" + to, output, 0.1, true, Detail));
        out.push_back(drawing("enlarge, whole picture" + to, output, 1, false, Off));
        out.push_back(drawing("blend, whole picture" + to, output, 1, true, Blend));
    }
    return out;
}

std::vector<BenchCase> benchCases() {
    return detailBenchCases();
}

}  // namespace mfar
