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
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// The pace at which a recording or the simulated board delivers its frames.
enum class SourcePace {
    Auto,      ///< Consumer for recordings, Realtime for other sources
    Realtime,  ///< at the times of the frames; frames that are not fetched in time are dropped
    Consumer,  ///< as fast as frames are fetched; no frame is dropped
};

struct SuperResConfig {
    SuperResMode mode = SuperResMode::Detail;
    bool skipUnchanged = true;
    bool learn = true;
    bool operator==(const SuperResConfig&) const = default;
};

struct StatusConfig {
    double intervalS = 1;
    bool measure = false;  ///< true: wait for the GPU after each stage, to measure its time
    bool operator==(const StatusConfig&) const = default;
};

struct RecordConfig {
    /// At each start, mfard creates a new folder in this directory, named after the current time.
    /// It records all frames and stills into the new folder. Empty: nothing is recorded.
    std::filesystem::path directory;
    double leastFreeMb = 512;
    double mostMb = 0;  ///< largest size of one recording; 0: no limit
    bool operator==(const RecordConfig&) const = default;
};

/// All settings of the daemon, from the configuration file and the command line. The defaults here
/// are equal to those in configOptions(); a test compares them.
struct Config {
    std::string source = "cameras";  ///< not used when `recording` is set
    std::filesystem::path recording;
    std::string display = "auto";
    PictureSize size;
    SourcePace pace = SourcePace::Auto;
    std::uint64_t seed = 1;
    std::filesystem::path recordTo;  ///< new folder to record into (--record); empty: none
    RecordConfig record;
    LimitsConfig limits;
    CamerasConfig cameras;
    SuperResConfig superres;
    TriggerConfig trigger;
    PoseConfig pose;
    GovernorConfig governor;
    StatusConfig status;
    EngineConfig engine;
    VirtualOptions virtualLayer;
    LightOptions light;
    std::vector<PlacedObject> objects;
    /// True: the outputs of all passes are checked. This is slow, so only the command line can set
    /// it.
    bool validate = false;
    /// Messages about keys that have no effect.
    std::vector<std::string> notes;
    /// The places of some keys in the file, as text that begins a message:
    /// "mfard.toml:3:15: cameras.calibration: ". These are the keys whose values are checked only
    /// after the whole file has been read, e.g. because they name another file.
    std::map<std::string, std::string, std::less<>> places;

    /// Returns the place of a key, or "" if `places` does not contain it.
    [[nodiscard]] std::string placeOf(std::string_view key) const {
        const auto place = places.find(key);
        return place == places.end() ? std::string() : place->second;
    }
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

/// Throws ConfigError, or Failure(NoInput) if the file cannot be read.
[[nodiscard]] Config loadConfig(const std::filesystem::path& file);

/// Returns warnings about a configuration: keys without effect, objects and parts of models that
/// are not shown.
[[nodiscard]] std::vector<std::string> notesOf(const Config& config);

/// Returns the text of a configuration file, which must be a regular file of at most 1 MiB. Throws
/// Failure(NoInput) if it cannot be read.
[[nodiscard]] std::string readConfigText(const std::filesystem::path& file);

/// Returns the keys and sections that differ between the two configurations and take effect only
/// after a restart, e.g. "source, cameras". Returns an empty text if there are none.
[[nodiscard]] std::string needRestart(const Config& running, const Config& wanted);

/// These functions convert between a value and its word in the configuration and on the command
/// line. They return nothing for an unknown word.
[[nodiscard]] std::optional<SuperResMode> superResMode(std::string_view word);
[[nodiscard]] std::optional<SourcePace> sourcePace(std::string_view word);
[[nodiscard]] std::string_view name(SuperResMode mode);

}  // namespace mfar
