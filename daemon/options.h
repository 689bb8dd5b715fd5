#pragma once

#include "daemon/config.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The command line of mfard. What is absent here is left to the configuration file.
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
    std::optional<std::uint64_t> frames;           ///< end after that many pictures
    std::optional<double> seconds;                 ///< end after that time
    std::optional<std::filesystem::path> summary;  ///< "-" = standard output
    std::optional<std::filesystem::path> control;  ///< socket for mfarctl
    bool measure = false;
    bool validate = false;
};

/// What the command line asks for: a run, or only a text to be printed.
struct CommandLine {
    Options options;
    std::optional<std::string> print;  ///< --help, --version, --print-config
};

/// One option, for the manual page and completion.
struct ArgumentText {
    std::string names;  ///< "-h,--help"
    std::string value;  ///< "FILE"; empty: a flag
    std::string meaning;
};
[[nodiscard]] std::vector<ArgumentText> argumentTexts();

/// Throws Failure(Usage).
[[nodiscard]] CommandLine parseCommandLine(int argc, const char* const* argv);

/// The file named by --config, if any, with the command line's wishes on top. Throws ConfigError,
/// Failure(NoInput) for a missing file or tag map, Failure(BadData) for a tag map that is wrong and
/// Failure(BadConfig) for what does not go together.
[[nodiscard]] Config effectiveConfig(const Options& options);

}  // namespace mfar
