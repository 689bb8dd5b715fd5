#include "daemon/options.h"

#include "daemon/exit_code.h"
#include "daemon/number_range.h"
#include "daemon/option_text.h"
#include "daemon/rig_inputs.h"
#include "daemon/rig_words.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <system_error>

#include <charconv>
#include <utility>

namespace mfar {
namespace {

CLI::Validator accepts(std::optional<std::string> (*fault)(std::string_view), const char* name) {
    return {[fault](std::string& given) { return fault(given).value_or(""); }, "", name};
}

template <class E>
CLI::Validator oneOf(std::optional<E> (*meaning)(std::string_view), const std::string& words) {
    return {[meaning, words](std::string& given) {
                return meaning(given) ? std::string() : "\"" + given + "\" is not one of " + words;
            },
            "", words};
}

std::optional<std::string> countFault(std::string_view given) {
    if (hasLeadingZero(given)) return fmt::format("\"{}\" has a leading zero", given);
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), count);
    if (error == std::errc() && end == given.data() + given.size() && count > 0)
        return std::nullopt;
    return fmt::format("\"{}\" is not a whole number of at least 1", given);
}

std::optional<std::string> reportFault(std::string_view given) {
    if (given != "-") return std::nullopt;
    return "the report cannot go to standard output, because it is written twice; name a file";
}

struct Words {
    std::string mode;
    std::string engine;
    std::string pace;
    std::string pose;
    std::string size;
};

template <class T>
CLI::Option* addKey(CLI::App& app, const char* name, T& out, const char* value) {
    return app.add_option(name, out, helpFor(name))->type_name(value);
}

template <class E>
void addWord(CLI::App& app, const char* name, std::string& out, const char* value,
             std::optional<E> (*meaning)(std::string_view)) {
    addKey(app, name, out, value)->check(oneOf(meaning, wordsFor(name)));
}

void addKeys(CLI::App& app, Options& options, Words& words) {
    CLI::Option* source =
        addKey(app, "--source", options.source, "SOURCE")->check(accepts(sourceFault, "source"));
    addKey(app, "--recording", options.recording, "DIR")->excludes(source);
    addWord(app, "--pace", words.pace, "PACE", sourcePace);
    addWord(app, "--pose", words.pose, "POSE", poseOrigin);
    addKey(app, "--seed", options.seed, "N")->check(unsigned64());
    addKey(app, "--display", options.display, "DISPLAY")->check(accepts(displayFault, "display"));
    addKey(app, "--size", words.size, "SIZE")->check(accepts(pictureSizeFault, "size"));
    addWord(app, "--mode", words.mode, "MODE", superResMode);
    addWord(app, "--engine", words.engine, "ENGINE", engineWish);
    app.add_flag("--measure", options.measure, helpFor("--measure"));
}

void addOthers(CLI::App& app, Options& options, bool& printConfig) {
    app.set_help_flag("-h,--help", "Print this text");
    app.set_version_flag("--version", "mfard " MFAR_VERSION, "Print the version");
    app.add_option("--config", options.config, "Configuration file (TOML)")->type_name("FILE");
    app.add_flag("--check-config", options.checkConfig,
                 "Only check the configuration: print ok, or its faults with their lines. The\n"
                 "files that it names are checked only if all keys are correct");
    app.add_flag("--print-config", printConfig,
                 "Only print a configuration file with every key, its meaning and default");
    app.add_flag("--release-trigger", options.releaseTrigger,
                 "Set the trigger line of --config to its inactive level and end");
    app.add_option("--record", options.recordTo, "Record video and stills into this new folder")
        ->type_name("DIR");
    app.add_option("--frames", options.frames, "End after N pictures")
        ->check(accepts(countFault, "count"))
        ->type_name("N");
    app.add_option("--seconds", options.seconds, "End after S seconds")->type_name("S");
    app.add_option("--summary", options.summary,
                   "At the end, write all measurements to this file (JSON); \"-\" prints them")
        ->type_name("FILE");
    app.add_option("--report", options.report,
                   "Write a page with charts and pictures to this file (HTML), at the start\nand "
                   "at the end")
        ->check(accepts(reportFault, ""))
        ->type_name("FILE");
    app.add_option(
           "--control", options.control,
           "Create this socket, through which mfarctl controls mfard. Members of mfard's\n"
           "group may use status and stats. Those who are also in the group mfar-operators\n"
           "may use every command")
        ->type_name("SOCKET");
    app.add_flag("--validate", options.validate,
                 "Check that the engine writes no NaN, infinity or value out of range, and log\n"
                 "faults. mfard becomes about ten times slower. Needs OpenGL ES");
}

struct Parser {
    CLI::App app{"mfard: lifts a fast video sensor to the resolution of a slow still sensor.\n"
                 "Signals: TERM and INT end mfard; HUP makes it read its configuration again.\n",
                 "mfard"};
    Options options;
    Words words;
    bool printConfig = false;

    Parser() {
        app.get_formatter()->column_width(26);
        addOthers(app, options, printConfig);
        addKeys(app, options, words);
    }
};

}  // namespace

std::vector<ArgumentText> argumentTexts() {
    return argumentTexts(Parser().app);
}

CommandLine parseCommandLine(int argc, const char* const* argv) {
    CommandLine line;
    Parser parser;
    try {
        parser.app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        line.print = parser.app.help();
    } catch (const CLI::CallForVersion& version) {
        line.print = std::string(version.what()) + "\n";
    } catch (const CLI::ParseError& error) {
        throw Failure(ExitCode::Usage, std::string(error.what()) + " (mfard --help explains)");
    }
    if (parser.printConfig) line.print = defaultConfigText();
    line.options = parser.options;
    const Words& words = parser.words;
    // `seconds` may be NaN. Then both comparisons are false, and NaN is refused.
    const double seconds = line.options.seconds.value_or(1);
    if (!(seconds > 0 && seconds <= 1e7))
        throw Failure(ExitCode::Usage, "--seconds must be more than 0 and at most 1e7");
    if (line.options.releaseTrigger && !line.options.config)
        throw Failure(ExitCode::Usage, "--release-trigger needs --config FILE");
    if (!words.mode.empty()) line.options.mode = superResMode(words.mode);
    if (!words.engine.empty()) line.options.engine = engineWish(words.engine);
    if (!words.pace.empty()) line.options.pace = sourcePace(words.pace);
    if (!words.size.empty()) line.options.size = pictureSize(words.size);
    if (!words.pose.empty()) line.options.pose = poseOrigin(words.pose);
    return line;
}

Config effectiveConfig(const Options& options) {
    Config config = options.config ? loadConfig(*options.config) : Config{};
    if (options.source) {
        config.source = *options.source;
        config.recording.clear();
    }
    if (options.recording) {
        config.recording = *options.recording;
        config.places.erase("recording");
    }
    if (options.display) config.display = *options.display;
    if (options.size) config.size = *options.size;
    if (options.recordTo) config.recordTo = *options.recordTo;
    if (options.mode) config.superres.mode = *options.mode;
    if (options.engine) {
        config.engine = {};
        config.engine.use = *options.engine;
    }
    if (options.pace) config.pace = *options.pace;
    if (options.pose) config.pose.source = *options.pose;
    if (options.seed) config.seed = *options.seed;
    if (options.measure) config.status.measure = true;
    config.validate = options.validate;
    if (config.pose.source == PoseOrigin::Recorded && config.recording.empty())
        throw Failure(ExitCode::BadConfig,
                      (options.pose ? "--pose: " : config.placeOf("pose.source")) +
                          "\"recorded\" needs a recording: set the key recording or the option "
                          "--recording, or choose \"tags\" or \"none\"");
    return config;
}

Config usableConfig(const Options& options) {
    Config config = effectiveConfig(options);
    requireFiles(config, options.checkConfig ? RecordingCheck::Lists : RecordingCheck::Folder);
    return config;
}

}  // namespace mfar
