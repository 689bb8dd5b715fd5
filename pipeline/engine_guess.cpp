#include "pipeline/engine_guess.h"

#include <algorithm>
#include <array>

namespace mfar {
namespace {

/// Predicted time of a frame while the camera moves [ms], on one GPU. There is one time for each
/// assignment of the steps to engines.
struct Prediction {
    std::string_view gpu;
    double simd, matchSimdDrawGles, matchGlesDrawSimd, gles;
};

constexpr Prediction kPredictions[] = {
#include "pipeline/predicted_frames.inc"
};

EngineChoice placed(EngineKind matching, EngineKind drawing) {
    EngineChoice choice = EngineChoice::all(drawing);
    choice.pyramid = choice.flow = choice.weigh = matching;
    return choice;
}

struct Candidate {
    EngineChoice engines;
    double Prediction::* frame;
};

/// The assignments that promisingEngines() considers, in the order in which they are tried on a GPU
/// without predicted times. SIMD is first, because it needs no shader compilation.
std::array<Candidate, 4> candidates() {
    constexpr auto kSimd = EngineKind::Simd, kGles = EngineKind::Gles;
    return {{{placed(kSimd, kSimd), &Prediction::simd},
             {placed(kSimd, kGles), &Prediction::matchSimdDrawGles},
             {placed(kGles, kGles), &Prediction::gles},
             {placed(kGles, kSimd), &Prediction::matchGlesDrawSimd}}};
}

}  // namespace

std::vector<EngineChoice> promisingEngines(std::string_view driver) {
    auto all = candidates();
    const auto* known = std::ranges::find_if(
        kPredictions, [&](const Prediction& p) { return driver.find(p.gpu) != driver.npos; });
    auto last = all.end();
    if (known != std::end(kPredictions)) {
        const auto frame = [known](const Candidate& c) { return known->*c.frame; };
        std::ranges::stable_sort(all, {}, frame);
        last = std::ranges::upper_bound(all, kHopelessFrame * frame(all.front()), {}, frame);
    }
    std::vector<EngineChoice> out;
    std::transform(all.begin(), last, std::back_inserter(out),
                   [](const Candidate& c) { return c.engines; });
    return out;
}

}  // namespace mfar
