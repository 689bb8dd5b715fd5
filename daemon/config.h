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

/// Who sets the speed of a virtual source.
enum class SourcePace {
    Auto,      ///< Consumer for recordings, Realtime for every other source
    Realtime,  ///< the source's own timestamps; frames nobody takes in time are dropped
    Consumer,  ///< as fast as frames are taken; none is dropped
};

struct SuperResConfig {
    SuperResMode mode = SuperResMode::Detail;
    bool skipUnchanged = true;
    bool learn = true;  ///< the enlarger's filters, from matched stills
    bool operator==(const SuperResConfig&) const = default;
};

struct StatusConfig {
    double intervalS = 1;
    bool measure = false;  ///< wait for the GPU after each stage, so that its time is the work's
    bool operator==(const StatusConfig&) const = default;
};

struct RecordConfig {
    /// Everything is recorded, in a new folder of this one, named by the start's time. Empty: not.
    std::filesystem::path directory;
    double leastFreeMb = 512;  ///< stays free on the disk
    double mostMb = 0;         ///< of one recording; 0: no limit
    bool operator==(const RecordConfig&) const = default;
};

/// Everything the daemon can be told, from the configuration file and the command line. The
/// defaults here are those of option_table.h; a test compares both.
struct Config {
    std::string source = "cameras";   ///< not used when `recording` is set
    std::filesystem::path recording;  ///< empty: none
    std::string display = "auto";
    PictureSize size;
    SourcePace pace = SourcePace::Auto;
    std::uint64_t seed = 1;          ///< of the synthetic board
    std::filesystem::path recordTo;  ///< a new folder; empty: none
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
    bool validate = false;  ///< check what every pass writes; not in the file, as it is slow
};

/// The configuration file is wrong. The message has one line per fault, each
/// "file:line:column: what is wrong".
class ConfigError : public Failure {
public:
    explicit ConfigError(const std::string& message) : Failure(ExitCode::BadConfig, message) {}
};

/// Reads text as configuration; keys that are absent keep their defaults. `file` is for messages,
/// and a tag map without an absolute path is beside it.
/// Throws ConfigError with every fault found.
[[nodiscard]] Config parseConfig(std::string_view toml, const std::string& file);

/// Reads a file. Throws ConfigError, or Failure(NoInput) when it cannot be read.
[[nodiscard]] Config loadConfig(const std::filesystem::path& file);

/// The text of such a file, which is a regular one of at most 1 MiB. Throws Failure(NoInput) when
/// it cannot be read.
[[nodiscard]] std::string readConfigText(const std::filesystem::path& file);

/// Names of what differs between two configurations and cannot be changed while running,
/// "source, display"; empty when there is no such thing.
[[nodiscard]] std::string needRestart(const Config& running, const Config& wanted);

/// Words of the configuration and the command line. Nothing when the word is unknown.
[[nodiscard]] std::optional<SuperResMode> superResMode(std::string_view word);
[[nodiscard]] std::optional<SourcePace> sourcePace(std::string_view word);
[[nodiscard]] std::string_view name(SuperResMode mode);

}  // namespace mfar
