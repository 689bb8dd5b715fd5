#pragma once

#include "pipeline/quality.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// One trade-off between speed and accuracy, as measured.
struct QualityLevel {
    std::string name;
    double ms = 0;      ///< of a whole frame in which everything moves, on the measuring machine
    double psnrDb = 0;  ///< of its pictures against ground truth
    Quality quality;
};

/// The Pareto front that `mfar-bench pareto --table FILE` measured on two x86-64 cores without a
/// GPU, from fast to accurate. The command writes the front of the machine that it runs on.
[[nodiscard]] const std::vector<QualityLevel>& builtInQualityLevels();

/// Parses the text of a table with sections [[level]], whose keys levelOptions() lists; sorts the
/// levels by time. Throws ConfigError with every fault; `file` is for messages.
[[nodiscard]] std::vector<QualityLevel> parseQualityLevels(std::string_view toml,
                                                           const std::string& file);

/// Text that parseQualityLevels() reads.
[[nodiscard]] std::string toToml(std::span<const QualityLevel> levels);

/// The levels with their modes limited to `best`. Of levels that become equal, the fastest stays.
[[nodiscard]] std::vector<QualityLevel> limitedTo(std::span<const QualityLevel> levels,
                                                  SuperResMode best);

}  // namespace mfar
