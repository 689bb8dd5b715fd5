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
    double ms = 0;      ///< time of a frame in which everything moves, on the measuring machine
    double psnrDb = 0;  ///< PSNR of the pictures against ground truth [dB]
    Quality quality;
};

/// Returns the built-in table of levels: the Pareto front that `mfar-bench pareto --table FILE`
/// measured on two x86-64 cores without a GPU, from fast to accurate. On another machine, the
/// command writes that machine's front.
[[nodiscard]] const std::vector<QualityLevel>& builtInQualityLevels();

/// Parses the text of a table with sections [[level]], whose keys levelOptions() lists. Returns the
/// levels, sorted by time. `file` names the file in messages. Throws ConfigError with all faults.
[[nodiscard]] std::vector<QualityLevel> parseQualityLevels(std::string_view toml,
                                                           const std::string& file);

/// Returns the levels as a TOML text that parseQualityLevels() can read.
[[nodiscard]] std::string toToml(std::span<const QualityLevel> levels);

/// Returns the levels, with every mode that is better than `best` replaced by `best`. If several
/// levels become equal, only the fastest of them is kept.
[[nodiscard]] std::vector<QualityLevel> limitedTo(std::span<const QualityLevel> levels,
                                                  SuperResMode best);

}  // namespace mfar
