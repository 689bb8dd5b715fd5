#pragma once

#include "pipeline/quality.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// One step between fast and accurate, as measured.
struct QualityLevel {
    std::string name;
    double ms = 0;      ///< of a whole frame in which everything moves, where it was measured
    double psnrDb = 0;  ///< of its pictures against the true ones
    Quality quality;
};

/// The front that `mfar-bench pareto --table FILE` measured on two x86-64 cores without a GPU, from
/// fast to accurate; it writes that of another machine.
[[nodiscard]] const std::vector<QualityLevel>& builtInQualityLevels();

/// Levels from the text of such a file with sections [[level]], whose keys levelOptions() lists,
/// sorted by their times. Throws ConfigError with every fault; `file` is for messages.
[[nodiscard]] std::vector<QualityLevel> parseQualityLevels(std::string_view toml,
                                                           const std::string& file);

/// What parseQualityLevels() reads.
[[nodiscard]] std::string toToml(std::span<const QualityLevel> levels);

/// The levels with no mode beyond `best`: of those that then are the same, the fastest.
[[nodiscard]] std::vector<QualityLevel> limitedTo(std::span<const QualityLevel> levels,
                                                  SuperResMode best);

}  // namespace mfar
