#include "tests/lint/planted.h"

#include <algorithm>
#include <vector>

namespace mfar::planted {
namespace {

int firstPositive(const std::vector<std::string>& texts, int number) {
    for (const auto text : texts) {  // performance-for-range-copy
        if (text.size() == 0) {      // readability-container-size-empty
            return 0;
        } else {  // readability-else-after-return
            number += MFAR_TWICE(number);
        }
    }
    return number;
}

}  // namespace

// The standard library calls this lambda, which contains the fault.
double sumOfHalves(const std::vector<int>& values) {
    double sum = 0;
    std::for_each(values.begin(), values.end(), [&sum](int value) {
        sum += value / 2;  // bugprone-integer-division
    });
    return sum + Halves<int>().half() + firstPositive({used(std::string("a"))}, 1);
}

extern "C" unsigned long mfarPlanted(const char* text) {
    int unused = 0;  // clang-diagnostic-unused-variable
    return lengthOf(text) + std::hash<name_of_a_struct>()({});
}

}  // namespace mfar::planted
