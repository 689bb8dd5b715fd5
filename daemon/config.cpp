#include "daemon/config.h"

#include "base/bounded_file.h"
#include "daemon/exit_code.h"
#include "daemon/rig_words.h"
#include "daemon/toml_reader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kMostConfigBytes = 1 << 20;
constexpr std::array kPlacedKeys{"recording",       "cameras.calibration", "pose.source",
                                 "pose.tags",       "governor.table",      "governor.pin",
                                 "limits.memory_mb"};

template <class E>
using Word = std::pair<std::string_view, E>;

constexpr std::array<Word<SuperResMode>, 3> kSuperResModes = {
    {{"detail", SuperResMode::Detail}, {"blend", SuperResMode::Blend}, {"off", SuperResMode::Off}}};
constexpr std::array<Word<SourcePace>, 3> kPaces = {{{"auto", SourcePace::Auto},
                                                     {"realtime", SourcePace::Realtime},
                                                     {"consumer", SourcePace::Consumer}}};
constexpr std::array<Word<TriggerMode>, 3> kTriggerModes = {
    {{"demand", TriggerMode::Demand}, {"rate", TriggerMode::Rate}, {"off", TriggerMode::Off}}};

template <class E>
std::optional<E> meaning(std::span<const Word<E>> words, std::string_view word) {
    for (const auto& [known, value] : words)
        if (known == word) return value;
    return std::nullopt;
}

std::filesystem::path besides(const std::string& file, const std::filesystem::path& path) {
    return std::filesystem::path(file).parent_path() / path;
}

void readTrigger(TomlReader& file, TriggerConfig& trigger) {
    file.choice<TriggerMode>("trigger.mode", trigger.mode, kTriggerModes);
    file.number("trigger.rate_hz", trigger.rateHz);
    file.number("trigger.explained_below", trigger.explainedBelow);
    file.number("trigger.max_age_s", trigger.maxAgeS);
    file.number("trigger.min_interval_s", trigger.minIntervalS);
    file.number("trigger.timeout_s", trigger.timeoutS);
}

void readRecord(TomlReader& file, RecordConfig& record) {
    std::string directory;
    file.text("record.directory", directory);
    record.directory = directory;
    file.number("record.least_free_mb", record.leastFreeMb);
    file.number("record.most_mb", record.mostMb);
}

}  // namespace

Config parseConfig(std::string_view toml, const std::string& fileName) {
    Config config;
    TomlReader file(toml, fileName, configOptions(), "mfard --print-config");
    file.text("source", config.source, sourceFault);
    std::string recording;
    file.text("recording", recording);
    if (!recording.empty()) config.recording = besides(fileName, recording);
    file.text("display", config.display, displayFault);
    std::string size;
    file.text("size", size, pictureSizeFault);
    if (!size.empty()) config.size = *pictureSize(size);
    file.choice<SourcePace>("pace", config.pace, kPaces);
    file.integer("seed", config.seed);
    file.choice<SuperResMode>("superres.mode", config.superres.mode, kSuperResModes);
    file.boolean("superres.skip_unchanged", config.superres.skipUnchanged);
    file.boolean("superres.learn", config.superres.learn);
    readTrigger(file, config.trigger);
    readCameras(file, config.trigger.timeoutS, config.cameras);
    if (!config.cameras.calibration.empty())
        config.cameras.calibration = besides(fileName, config.cameras.calibration);
    readPose(file, config.pose);
    if (!config.pose.tags.empty()) config.pose.tags = besides(fileName, config.pose.tags);
    readGovernor(file, config.governor);
    if (!config.governor.table.empty())
        config.governor.table = besides(fileName, config.governor.table);
    readRecord(file, config.record);
    file.number("status.interval_s", config.status.intervalS);
    file.boolean("status.measure", config.status.measure);
    const std::filesystem::path folder = std::filesystem::path(fileName).parent_path();
    readLimits(file, config.limits);
    FileMemory memory(config.limits);
    readEngine(file, config.engine);
    readVirtual(file, config.virtualLayer);
    readLight(file, folder, memory, config.light);
    readObjects(file, folder, memory, config.objects, config.notes);
    for (const char* key : kPlacedKeys)
        if (const std::optional<std::string> place = file.placeOf(key)) config.places[key] = *place;
    file.finish();
    return config;
}

std::vector<std::string> notesOf(const Config& config) {
    std::vector<std::string> out = config.notes;
    if (config.pose.source == PoseOrigin::None && !config.objects.empty())
        out.emplace_back("no object of [[objects]] is shown, because pose.source is \"none\"");
    std::ranges::move(modelNotes(config.objects), std::back_inserter(out));
    return out;
}

std::string readConfigText(const std::filesystem::path& file) {
    try {
        return boundedText(file, kMostConfigBytes);
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::NoInput, file.string() + ": cannot be read: it " + error.what());
    }
}

Config loadConfig(const std::filesystem::path& file) {
    return parseConfig(readConfigText(file), file.string());
}

std::string needRestart(const Config& running, const Config& wanted) {
    std::string names;
    const auto compare = [&](bool same, const char* key) {
        if (!same) names += (names.empty() ? "" : ", ") + std::string(key);
    };
    compare(running.source == wanted.source, "source");
    compare(running.recording == wanted.recording, "recording");
    compare(running.cameras == wanted.cameras, "cameras");
    compare(running.display == wanted.display, "display");
    compare(running.size == wanted.size, "size");
    compare(running.pace == wanted.pace, "pace");
    compare(running.seed == wanted.seed, "seed");
    compare(running.record == wanted.record, "record");
    compare(running.limits == wanted.limits, "limits");
    // [pose] needs a restart: another tag map defines another world frame, and a new tracker has no
    // pose for a while.
    compare(running.pose == wanted.pose, "pose");
    compare(running.engine == wanted.engine, "engine");
    compare(running.virtualLayer == wanted.virtualLayer, "virtual");
    compare(running.governor == wanted.governor, "governor");
    return names;
}

std::optional<SuperResMode> superResMode(std::string_view word) {
    return meaning<SuperResMode>(kSuperResModes, word);
}

std::optional<SourcePace> sourcePace(std::string_view word) {
    return meaning<SourcePace>(kPaces, word);
}

std::string_view name(SuperResMode mode) {
    for (const auto& [word, value] : kSuperResModes)
        if (value == mode) return word;
    return "";
}

}  // namespace mfar
