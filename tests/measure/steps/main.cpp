#include "tests/measure/steps/cases.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string_view>

namespace mfar {
namespace {

constexpr int kWarmUp = 3;
constexpr double kSeconds = 1;  // duration of a measurement [s]
constexpr std::size_t kFewest = 10;

void measure(const BenchCase& which, int threads) {
    using Clock = std::chrono::steady_clock;
    const auto run = which.make(std::make_shared<Workers>(threads));
    for (int i = 0; i < kWarmUp; ++i)
        run();
    std::vector<double> ms;
    const auto begin = Clock::now();
    while (ms.size() < kFewest ||
           std::chrono::duration<double>(Clock::now() - begin).count() < kSeconds) {
        const auto before = Clock::now();
        run();
        ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - before).count());
    }
    std::ranges::sort(ms);
    std::printf("%-44s %d thread%s  min %8.3f  median %8.3f ms\n", which.name.c_str(), threads,
                threads == 1 ? " " : "s", ms.front(), ms[ms.size() / 2]);
    std::fflush(stdout);
}

}  // namespace
}  // namespace mfar

// Times the SIMD steps whose names contain the argument. Usage: mfar-simd-bench [PART-OF-A-NAME].
int main(int argc, char** argv) {
    const std::string_view wanted = argc > 1 ? argv[1] : "";
    for (const mfar::BenchCase& which : mfar::benchCases()) {
        if (which.name.find(wanted) == std::string::npos) continue;
        for (const int threads : {1, 2})
            mfar::measure(which, threads);
    }
}
