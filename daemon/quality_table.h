#pragma once

#include "pipeline/quality.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// A level: one setting between fast and accurate, with its measured time and accuracy.
struct QualityLevel {
    std::string name;
    double ms = 0;      ///< time of a frame in which everything moves, as measured
    double psnrDb = 0;  ///< PSNR of the pictures against ground truth
    Quality quality;
};

/// Returns the built-in levels, from fast to accurate. They are the Pareto front that `mfar-bench
/// pareto --table FILE` measured on two x86-64 cores without a GPU. The same command measures the
/// front of another machine.
[[nodiscard]] const std::vector<QualityLevel>& builtInQualityLevels();

/// Parses a TOML text with sections [[level]], whose keys levelOptions() lists. Returns the levels,
/// sorted by time. `file` names the file in messages. Throws ConfigError with all faults of the
/// keys, or with the first level that lacks a required key or has the name of another level.
[[nodiscard]] std::vector<QualityLevel> parseQualityLevels(std::string_view toml,
                                                           const std::string& file);

[[nodiscard]] std::string toToml(std::span<const QualityLevel> levels);

/// Limits the levels to the mode `best`. A level with a better mode gets the mode `best`. If levels
/// become equal, only the fastest of them is kept.
[[nodiscard]] std::vector<QualityLevel> limitedTo(std::span<const QualityLevel> levels,
                                                  SuperResMode best);

}  // namespace mfar
