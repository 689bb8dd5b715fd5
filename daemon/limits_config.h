#pragma once

#include "base/geometry.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mfar {

class TomlReader;

/// Section [limits]: memory that the daemon may use for its input.
struct LimitsConfig {
    double memoryMb = 0;  ///< 0: three quarters of machineMemory(), at most 4096

    bool operator==(const LimitsConfig&) const = default;
    /// The whole budget.
    [[nodiscard]] std::uint64_t memoryBytes() const;
    /// The share for the frame path and a recording: two thirds of the budget.
    [[nodiscard]] std::uint64_t pictureBytes() const;
};

void readLimits(TomlReader& file, LimitsConfig& limits);

/// The machine's memory, or this process's control group limit where that is less [byte].
[[nodiscard]] std::uint64_t machineMemory();

/// Refuses picture sizes that need more than pictureBytes(), before any memory is allocated;
/// `lists` is what a recording's lists need of it. `place` is for the message. Throws
/// Failure(BadData).
void requireMemory(const LimitsConfig& limits, Size video, Size still, std::string_view place,
                   std::size_t lists = 0);

/// Budget of one configuration's models and environments: a sixth of the whole, as those in use are
/// released only after new ones have been read. Reduced as files are read.
class FileMemory {
public:
    explicit FileMemory(const LimitsConfig& limits);

    [[nodiscard]] std::size_t left() const { return left_; }
    void take(std::size_t bytes) { left_ -= bytes < left_ ? bytes : left_; }

private:
    std::size_t left_;
};

}  // namespace mfar
