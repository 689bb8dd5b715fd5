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

/// The pace at which a recording or the simulated board delivers its frames.
enum class SourcePace {
    Auto,      ///< Consumer for recordings, Realtime for every other source
    Realtime,  ///< at the times of the frames; frames that are not fetched in time are dropped
    Consumer,  ///< as fast as frames are fetched; no frame is dropped
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
    /// Each start records all frames and stills into a new folder inside this one. The new folder's
    /// name is the time. Empty: nothing is recorded.
    std::filesystem::path directory;
    double leastFreeMb = 512;  ///< disk space that must stay free
    double mostMb = 0;         ///< largest size of one recording; 0: no limit
    bool operator==(const RecordConfig&) const = default;
};

/// All settings of the daemon, from the configuration file and the command line. The defaults here
/// are those of option_table.h; a test compares both.
struct Config {
    std::string source = "cameras";   ///< not used when `recording` is set
    std::filesystem::path recording;  ///< recording to play; empty: none
    std::string display = "auto";
    PictureSize size;
    SourcePace pace = SourcePace::Auto;
    std::uint64_t seed = 1;          ///< seed of the random numbers of the simulated board
    std::filesystem::path recordTo;  ///< new folder to record into (--record); empty: none
    RecordConfig record;
    LimitsConfig limits;
    CamerasConfig cameras;  ///< used if source is "cameras"
    SuperResConfig superres;
    TriggerConfig trigger;
    PoseConfig pose;
    GovernorConfig governor;
    StatusConfig status;
    EngineConfig engine;
    VirtualOptions virtualLayer;
    LightOptions light;
    std::vector<PlacedObject> objects;
    /// Whether the outputs of all passes are checked; slow, so only on the command line.
    bool validate = false;
};

/// Reports that a configuration file is invalid. The message has one line per fault:
/// "file:line:column: fault".
class ConfigError : public Failure {
public:
    explicit ConfigError(const std::string& message) : Failure(ExitCode::BadConfig, message) {}
};

/// Parses the text of a configuration file. Absent keys keep their defaults. `file` is the file's
/// path: messages name it, and relative paths in the text are relative to its folder. Throws
/// ConfigError with all faults.
[[nodiscard]] Config parseConfig(std::string_view toml, const std::string& file);

/// Reads a configuration file. Throws ConfigError, or Failure(NoInput) if the file cannot be read.
[[nodiscard]] Config loadConfig(const std::filesystem::path& file);

/// Returns the text of a configuration file, which must be a regular file of at most 1 MiB. Throws
/// Failure(NoInput) if it cannot be read.
[[nodiscard]] std::string readConfigText(const std::filesystem::path& file);

/// Returns the names of the keys that differ between two configurations and take effect only after
/// a restart, e.g. "source, display". If there are none, the text is empty.
[[nodiscard]] std::string needRestart(const Config& running, const Config& wanted);

/// These functions convert between a value and the word for it in the configuration and on the
/// command line. For an unknown word, they return nothing.
[[nodiscard]] std::optional<SuperResMode> superResMode(std::string_view word);
[[nodiscard]] std::optional<SourcePace> sourcePace(std::string_view word);
[[nodiscard]] std::string_view name(SuperResMode mode);

}  // namespace mfar
