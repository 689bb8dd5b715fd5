#include "daemon/process_use.h"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

namespace mfar {
namespace {

double seconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Returns the time since the process started. Field 22 of /proc/self/stat is the start time, in
// clock ticks since boot, see proc(5). Field 2 is the program's name in brackets. It may contain
// spaces, so fields are counted from the closing bracket on.
double secondsSinceStart() {
    constexpr int kStartTime = 22;
    std::ifstream file("/proc/self/stat");
    file.ignore(std::numeric_limits<std::streamsize>::max(), ')');
    std::string skipped;
    for (int field = 3; field < kStartTime; ++field)
        file >> skipped;
    double ticks = 0;
    if (!(file >> ticks)) return 0;
    const double began = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
    return std::max(seconds(CLOCK_BOOTTIME) - began, 0.0);
}

double residentBytes() {
    double all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

ProcessUse processUse() {
    return {1e3 * secondsSinceStart(), 1e3 * seconds(CLOCK_PROCESS_CPUTIME_ID),
            1e-6 * residentBytes()};
}

}  // namespace mfar
