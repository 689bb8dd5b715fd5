#include "tests/stability/balance.h"

#include <algorithm>
#include <string_view>

namespace mfar::stress {
namespace {

constexpr double kTrial = 60;  // longest time to run a case that has not reached the pass [s]

}  // namespace

Balance::Balance(const std::vector<Case>& cases) {
    for (const Case& one : cases)
        if (one.atProductSize) cases_.push_back({one, 0, {}, {}});
}

const Balance::Known* Balance::quickest(const std::string& pass) const {
    const Known* out = nullptr;
    const auto rate = [&](const Known& known) {
        const auto found = known.pixels.find(pass);
        return found == known.pixels.end() ? 0 : static_cast<double>(found->second) / known.seconds;
    };
    for (const Known& known : cases_)
        if (rate(known) > (out != nullptr ? rate(*out) : 0)) out = &known;
    if (out != nullptr) return out;
    const auto untried = std::ranges::find_if(cases_, [&](const Known& known) {
        return known.passes.contains(pass) && known.seconds < kTrial;
    });
    return untried == cases_.end() ? nullptr : &*untried;
}

const Case* Balance::next(const Checks& checks, long enough) const {
    for (const Known& known : cases_)
        if (known.seconds == 0) return &known.one;
    const Known* chosen = nullptr;
    long fewest = enough;
    for (const auto& [pass, pixels] : checks.pixels()) {
        const Known* quick = pixels < fewest ? quickest(pass) : nullptr;
        if (quick == nullptr) continue;
        chosen = quick;
        fewest = pixels;
    }
    return chosen != nullptr ? &chosen->one : nullptr;
}

void Balance::ran(const Case& one, const std::map<std::string, long>& before,
                  const std::map<std::string, long>& after, double seconds, Scale scale) {
    const auto known = std::ranges::find_if(
        cases_, [&](const Known& k) { return std::string_view(k.one.name) == one.name; });
    if (known == cases_.end()) return;
    if (scale == Scale::Product) known->seconds += seconds;
    for (const auto& [pass, pixels] : after) {
        const auto was = before.find(pass);
        const long brought = pixels - (was == before.end() ? 0 : was->second);
        if (brought == 0) continue;
        known->passes.insert(pass);
        if (scale == Scale::Product) known->pixels[pass] += brought;
    }
}

}  // namespace mfar::stress
