#include "tests/stability/checks.h"

#include <fmt/format.h>

#include <utility>

namespace mfar::stress {

void Checks::fail(const std::string& what) {
    constexpr std::size_t kMost = 5;
    if (faults_.size() < kMost) faults_.push_back(what);
}

void Checks::failRange(double value, double low, double high, const char* what) {
    fail(fmt::format("{} is {}, not in {}..{}", what, value, low, high));
}

std::vector<std::string> Checks::take() {
    return std::exchange(faults_, {});
}

}  // namespace mfar::stress
