#pragma once

#include "daemon/cameras_config.h"
#include "daemon/engine_config.h"
#include "daemon/exit_code.h"
#include "daemon/governor_config.h"
#include "daemon/limits_config.h"
#include "daemon/objects_config.h"
#include "daemon/picture_size.h"
#include "daemon/pose_config.h"
#include "daemon/still_policy.h"
#include "daemon/virtual_config.h"
#include "pipeline/quality.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Clock of a virtual source.
enum class SourcePace {
    Auto,      ///< Consumer for recordings, Realtime for every other source
    Realtime,  ///< the source's own timestamps; frames that are not taken in time are dropped
    Consumer,  ///< as fast as frames are taken; no frame is dropped
};

struct SuperResConfig {
    SuperResMode mode = SuperResMode::Detail;
    bool skipUnchanged = true;
    bool learn = true;  ///< learn the enlarger's filters from matched stills
    bool operator==(const SuperResConfig&) const = default;
};

struct StatusConfig {
    double intervalS = 1;
    bool measure = false;  ///< wait for the GPU after each stage, to measure its work
    bool operator==(const StatusConfig&) const = default;
};

struct RecordConfig {
    /// All frames and stills are recorded in a new folder inside this one, named by the start's
    /// time. Empty: no recording.
    std::filesystem::path directory;
    double leastFreeMb = 512;  ///< disk space that stays free
    double mostMb = 0;         ///< size limit of one recording; 0: no limit
    bool operator==(const RecordConfig&) const = default;
};

/// All settings of the daemon, from the configuration file and the command line. The defaults here
/// are those of option_table.h; a test compares both.
struct Config {
    std::string source = "cameras";   ///< not used when `recording` is set
    std::filesystem::path recording;  ///< empty: none
    std::string display = "auto";
    PictureSize size;
    SourcePace pace = SourcePace::Auto;
    std::uint64_t seed = 1;          ///< seed of the synthetic board
    std::filesystem::path recordTo;  ///< a new folder; empty: no recording
    RecordConfig record;
    LimitsConfig limits;
    CamerasConfig cameras;  ///< used when source is "cameras"
    SuperResConfig superres;
    TriggerConfig trigger;
    PoseConfig pose;
    GovernorConfig governor;
    StatusConfig status;
    EngineConfig engine;
    VirtualOptions virtualLayer;
    LightOptions light;
    std::vector<PlacedObject> objects;
    bool validate = false;  ///< check every pass's output; slow, so not in the file
};

/// The configuration file is invalid. The message has one line per fault, each "file:line:column:
/// fault".
class ConfigError : public Failure {
public:
    explicit ConfigError(const std::string& message) : Failure(ExitCode::BadConfig, message) {}
};

/// Parses configuration text; keys that are absent keep their defaults. `file` is for messages, and
/// a relative path of a tag map is relative to its folder. Throws ConfigError with every fault
/// found.
[[nodiscard]] Config parseConfig(std::string_view toml, const std::string& file);

/// Reads a file. Throws ConfigError, or Failure(NoInput) when it cannot be read.
[[nodiscard]] Config loadConfig(const std::filesystem::path& file);

/// The text of a configuration file: a regular file of at most 1 MiB. Throws Failure(NoInput) when
/// it cannot be read.
[[nodiscard]] std::string readConfigText(const std::filesystem::path& file);

/// Names of the keys that differ between two configurations and need a restart, as in "source,
/// display"; empty when there are none.
[[nodiscard]] std::string needRestart(const Config& running, const Config& wanted);

/// Words of the configuration and the command line. Returns nothing for an unknown word.
[[nodiscard]] std::optional<SuperResMode> superResMode(std::string_view word);
[[nodiscard]] std::optional<SourcePace> sourcePace(std::string_view word);
[[nodiscard]] std::string_view name(SuperResMode mode);

}  // namespace mfar
