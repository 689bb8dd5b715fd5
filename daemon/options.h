#pragma once

#include "daemon/argument_text.h"
#include "daemon/config.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The options of mfard's command line. If an option is not set, the value in the configuration
/// file is used.
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
    std::optional<std::uint64_t> frames;           ///< number of pictures after which the run ends
    std::optional<double> seconds;                 ///< time after which the run ends
    std::optional<std::filesystem::path> summary;  ///< file for the summary; "-": standard output
    std::optional<std::filesystem::path> report;   ///< HTML file for the report of the run
    std::optional<std::filesystem::path> control;  ///< path of the socket for mfarctl
    bool measure = false;
    bool validate = false;
};

/// The parsed command line: the options of a run, or a text to be printed.
struct CommandLine {
    Options options;
    std::optional<std::string> print;  ///< set for --help, --version and --print-config
};

/// Returns the texts of mfard's options, for the manual page and shell completion.
[[nodiscard]] std::vector<ArgumentText> argumentTexts();

/// Parses the command line. Throws Failure(Usage).
[[nodiscard]] CommandLine parseCommandLine(int argc, const char* const* argv);

/// Returns the configuration of a run: the defaults or the file of --config, overridden by the
/// command line. Throws ConfigError; Failure(NoInput) if the configuration file or the tag map is
/// missing; Failure(BadData) if the tag map is invalid; Failure(BadConfig) if options contradict
/// each other.
[[nodiscard]] Config effectiveConfig(const Options& options);

}  // namespace mfar
