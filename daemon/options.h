#pragma once

#include "daemon/argument_text.h"
#include "daemon/config.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The command line of mfard. Absent values are taken from the configuration file.
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
    std::optional<std::uint64_t> frames;           ///< end after this number of pictures
    std::optional<double> seconds;                 ///< end after this time
    std::optional<std::filesystem::path> summary;  ///< "-" = standard output
    std::optional<std::filesystem::path> report;   ///< the same as a page of HTML
    std::optional<std::filesystem::path> control;  ///< socket for mfarctl
    bool measure = false;
    bool validate = false;
};

/// The parsed command line: options of a run, or a text to be printed.
struct CommandLine {
    Options options;
    std::optional<std::string> print;  ///< --help, --version, --print-config
};

/// For the manual page and shell completion.
[[nodiscard]] std::vector<ArgumentText> argumentTexts();

/// Throws Failure(Usage).
[[nodiscard]] CommandLine parseCommandLine(int argc, const char* const* argv);

/// The configuration of the file named by --config, if any, overridden by the command line. Throws
/// ConfigError, Failure(NoInput) for a missing file or tag map, Failure(BadData) for an invalid tag
/// map and Failure(BadConfig) for options that contradict each other.
[[nodiscard]] Config effectiveConfig(const Options& options);

}  // namespace mfar
