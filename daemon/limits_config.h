#pragma once

#include "base/geometry.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace mfar {

class TomlReader;

/// Section [limits] of the configuration: the memory that the daemon may use for its input.
struct LimitsConfig {
    double memoryMb = 0;  ///< memory budget [MiB]; 0: defaultMemory(machineMemory())

    bool operator==(const LimitsConfig&) const = default;
    [[nodiscard]] std::uint64_t memoryBytes() const;
    /// Returns the part of the memory budget for pictures and for the lists of a recording [bytes].
    /// It is two thirds of the budget.
    [[nodiscard]] std::uint64_t pictureBytes() const;
};

void readLimits(TomlReader& file, LimitsConfig& limits);

/// Returns the machine's memory, or the limit of this process's control group if that is less
/// [bytes].
[[nodiscard]] std::uint64_t machineMemory();
/// Returns the default memory budget: 3/4 of the machine's memory, at most 4096 MiB [bytes].
[[nodiscard]] std::uint64_t defaultMemory(std::uint64_t machine);
/// Returns the smallest memory limit of a process's control group and its parents [bytes]; 0: there
/// is no limit. `list`: the process's groups, as in /proc/self/cgroup. `top`: folder of the topmost
/// group.
[[nodiscard]] std::uint64_t controlGroupMemory(const std::filesystem::path& list,
                                               const std::filesystem::path& top);

/// Throws Failure(BadData) if pictures of these sizes and `lists` (the memory of a recording's
/// lists [bytes]) together need more memory than pictureBytes(). Must be called before the memory
/// is allocated. `place` names the source in messages.
void requireMemory(const LimitsConfig& limits, Size video, Size still, std::string_view place,
                   std::size_t lists = 0);

/// The memory that is left for the models and environment pictures of one configuration. It begins
/// with a sixth of the whole memory budget, and each file takes a part. A reload reads the new
/// files before it releases the old ones, so old and new files together may need two sixths.
class FileMemory {
public:
    explicit FileMemory(const LimitsConfig& limits);

    [[nodiscard]] std::size_t left() const { return left_; }
    void take(std::size_t bytes) { left_ -= bytes < left_ ? bytes : left_; }

private:
    std::size_t left_;
};

}  // namespace mfar
