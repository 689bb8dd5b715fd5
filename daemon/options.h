#pragma once

#include "daemon/argument_text.h"
#include "daemon/config.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The options of mfard's command line. An option that is not set leaves the configuration file's
/// value.
struct Options {
    std::optional<std::filesystem::path> config;
    bool checkConfig = false;
    bool releaseTrigger = false;
    std::optional<std::string> source;
    std::optional<std::filesystem::path> recording;
    std::optional<std::string> display;
    std::optional<PictureSize> size;
    std::optional<std::filesystem::path> recordTo;
    std::optional<SuperResMode> mode;
    std::optional<EngineWish> engine;
    std::optional<SourcePace> pace;
    std::optional<PoseOrigin> pose;
    std::optional<std::uint64_t> seed;
    /// The run ends after this number of pictures (`frames`), or after this time (`seconds`).
    std::optional<std::uint64_t> frames;
    std::optional<double> seconds;
    std::optional<std::filesystem::path> summary;  ///< file for the summary; "-": standard output
    std::optional<std::filesystem::path> report;
    std::optional<std::filesystem::path> control;
    bool measure = false;
    bool validate = false;
};

struct CommandLine {
    Options options;
    std::optional<std::string> print;
};

[[nodiscard]] std::vector<ArgumentText> argumentTexts();

/// Throws Failure(Usage).
[[nodiscard]] CommandLine parseCommandLine(int argc, const char* const* argv);

/// Returns the configuration of a run: the file of --config or the defaults, overridden by the
/// command line. Throws ConfigError or Failure: NoInput if the configuration file cannot be read,
/// BadConfig if pose.source is "recorded" without a recording.
[[nodiscard]] Config effectiveConfig(const Options& options);

/// Returns effectiveConfig() after a check of the files that it names, see requireFiles(). With
/// --check-config, the lists of a recording are checked, too. Throws as effectiveConfig() and
/// requireFiles().
[[nodiscard]] Config usableConfig(const Options& options);

}  // namespace mfar
