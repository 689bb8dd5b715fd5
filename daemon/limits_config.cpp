#include "daemon/limits_config.h"

#include "daemon/exit_code.h"
#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace mfar {
namespace {

constexpr double kMegabyte = 1 << 20;
constexpr double kLeastMb = 64;
/// kShareOfMachine: the default memory budget as a share of the machine's memory. The rest is for
/// the system, drivers and the program. kMostByMachine: largest default [bytes].
constexpr double kShareOfMachine = 0.75, kMostByMachine = 4096 * kMegabyte;
constexpr double kShareOfFrames = 2.0 / 3, kShareOfFiles = 1.0 / 6;
/// Memory of all buffers and textures [bytes per pixel of a still or video frame], measured with
/// pictures of several sizes.
constexpr double kBytesPerStillPixel = 36, kBytesPerVideoPixel = 150;

std::uint64_t physicalMemory() {
    const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    return pages > 0 && bytes > 0 ? static_cast<std::uint64_t>(pages) * bytes : 0;
}

}  // namespace

std::uint64_t controlGroupMemory(const std::filesystem::path& list,
                                 const std::filesystem::path& top) {
    std::ifstream groups(list);
    std::uint64_t least = 0;
    for (std::string line; std::getline(groups, line);) {
        if (!line.starts_with("0::/")) continue;
        std::filesystem::path group = line.substr(4);
        // The empty path is the topmost group that this process sees. In a container, it is the
        // container's own group, which may have a limit.
        for (bool isTop = false; !isTop; group = group.parent_path()) {
            isTop = group.empty();
            std::uint64_t bytes = 0;
            std::ifstream limit(top / group / "memory.max");
            if (limit >> bytes && bytes > 0) least = least == 0 ? bytes : std::min(least, bytes);
        }
    }
    return least;
}

std::uint64_t machineMemory() {
    const std::uint64_t physical = physicalMemory(),
                        group = controlGroupMemory("/proc/self/cgroup", "/sys/fs/cgroup");
    return group == 0 ? physical : std::min(physical, group);
}

std::uint64_t defaultMemory(std::uint64_t machine) {
    return static_cast<std::uint64_t>(
        std::min(kShareOfMachine * static_cast<double>(machine), kMostByMachine));
}

std::uint64_t LimitsConfig::memoryBytes() const {
    return memoryMb > 0 ? static_cast<std::uint64_t>(memoryMb * kMegabyte)
                        : defaultMemory(machineMemory());
}

std::uint64_t LimitsConfig::pictureBytes() const {
    return static_cast<std::uint64_t>(kShareOfFrames * static_cast<double>(memoryBytes()));
}

void readLimits(TomlReader& file, LimitsConfig& limits) {
    file.number("limits.memory_mb", limits.memoryMb, [](double mb) -> std::optional<std::string> {
        if (mb == 0 || mb >= kLeastMb) return std::nullopt;
        return fmt::format("must be 0 or at least {}", kLeastMb);
    });
}

void requireMemory(const LimitsConfig& limits, Size video, Size still, std::string_view place,
                   std::size_t lists) {
    const auto pixels = [](Size size) { return 1.0 * size.width * size.height; };
    const double needed = kBytesPerStillPixel * pixels(still) +
                          kBytesPerVideoPixel * pixels(video) + static_cast<double>(lists);
    const auto most = static_cast<double>(limits.pictureBytes());
    if (needed <= most) return;
    throw Failure(
        ExitCode::BadData,
        fmt::format(
            "{}: video of {}x{} and stills of {}x{} need about {:.0f} MB, but the {:.0f} "
            "MB of [limits] memory_mb leave only {:.0f} MB for pictures; use smaller pictures or a "
            "higher memory_mb",
            place, video.width, video.height, still.width, still.height, needed / kMegabyte,
            static_cast<double>(limits.memoryBytes()) / kMegabyte, most / kMegabyte));
}

FileMemory::FileMemory(const LimitsConfig& limits)
    : left_(static_cast<std::size_t>(kShareOfFiles * static_cast<double>(limits.memoryBytes()))) {}

}  // namespace mfar
