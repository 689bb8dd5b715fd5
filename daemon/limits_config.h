#pragma once

#include "base/geometry.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mfar {

class TomlReader;

/// Section [limits]: what the daemon may take for what it reads.
struct LimitsConfig {
    double memoryMb = 0;  ///< 0: three quarters of machineMemory(), at most 4096

    bool operator==(const LimitsConfig&) const = default;
    /// The budget.
    [[nodiscard]] std::uint64_t memoryBytes() const;
    /// The frame path's and a recording's share of it: two thirds.
    [[nodiscard]] std::uint64_t pictureBytes() const;
};

void readLimits(TomlReader& file, LimitsConfig& limits);

/// What the machine has, or this process's control group where that is less [byte].
[[nodiscard]] std::uint64_t machineMemory();

/// Refuses pictures for which pictureBytes() is too small, before memory is taken for them; `lists`
/// is what a recording's take of it. `place` is for the message. Throws Failure(BadData).
void requireMemory(const LimitsConfig& limits, Size video, Size still, std::string_view place,
                   std::size_t lists = 0);

/// The share of models and environments, which are read before the ones in use are given up: a
/// sixth of the budget each time. Taken from as files are read.
class FileMemory {
public:
    explicit FileMemory(const LimitsConfig& limits);

    [[nodiscard]] std::size_t left() const { return left_; }
    void take(std::size_t bytes) { left_ -= bytes < left_ ? bytes : left_; }

private:
    std::size_t left_;
};

}  // namespace mfar
