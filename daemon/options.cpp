#include "daemon/options.h"

#include "daemon/exit_code.h"
#include "daemon/rig_words.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace mfar {
namespace {

CLI::Validator accepts(std::optional<std::string> (*fault)(std::string_view), const char* name) {
    return {[fault](std::string& given) { return fault(given).value_or(""); }, "", name};
}

template <class E>
CLI::Validator oneOf(std::optional<E> (*meaning)(std::string_view), const char* words) {
    return {[meaning, words](std::string& given) {
                return meaning(given) ? std::string() : "\"" + given + "\" is none of " + words;
            },
            "", words};
}

struct Words {
    std::string mode;
    std::string engine;
    std::string pace;
    std::string pose;
    std::string size;
};

void addInputs(CLI::App& app, Options& options, Words& words) {
    app.add_option("--config", options.config, "Configuration file (TOML)")->type_name("FILE");
    app.add_flag("--check-config", options.checkConfig,
                 "Only check the configuration: prints ok, or every fault with its line");
    app.add_flag("--release-trigger", options.releaseTrigger,
                 "Only bring the trigger's line to its safe level, after a crash");
    CLI::Option* source = app.add_option("--source", options.source,
                                         "Where pictures come from: cameras (default), as\n"
                                         "configured, or synthetic[:SCENE[,PATH]]\n"
                                         "(" +
                                             sourceHelp() + ")")
                              ->check(accepts(sourceFault, "source"))
                              ->type_name("SOURCE");
    app.add_option("--recording", options.recording,
                   "Play this recording (folder in EuRoC layout) instead of a source")
        ->type_name("DIR")
        ->excludes(source);
    app.add_option("--pace", words.pace,
                   "realtime: the source's own speed, late frames are dropped;\n"
                   "consumer: as fast as frames are processed, none is dropped;\n"
                   "auto (default): consumer for recordings, realtime for the rest")
        ->check(oneOf(sourcePace, "auto, realtime, consumer"))
        ->type_name("PACE");
    app.add_option("--pose", words.pose,
                   "Where the camera's pose comes from: tags (default), recorded or none")
        ->check(oneOf(poseOrigin, "tags, recorded, none"))
        ->type_name("POSE");
    app.add_option("--seed", options.seed, "Random numbers of the synthetic source")
        ->type_name("N");
}

void addOutputs(CLI::App& app, Options& options, Words& words) {
    app.add_option("--display", options.display,
                   "Where pictures go: auto (default; the first screen there is),\n"
                   "kms[:cardN][,CONNECTOR][,WxH[@HZ]], fbdev[:/dev/fbN], none,\n"
                   "png:DIR (one file per frame) or y4m:FILE (one video file or named pipe)")
        ->check(accepts(displayFault, "display"))
        ->type_name("DISPLAY");
    app.add_option("--size", words.size,
                   "Of the pictures: screen (default; as large as the screen that is there at\n"
                   "the start shows them), still (the still's resolution), or WxH to fit into")
        ->check(accepts(pictureSizeFault, "size"))
        ->type_name("SIZE");
    app.add_option("--mode", words.mode,
                   "Super-resolution: detail (default; the still's detail as far as the\n"
                   "video confirms it), blend (fades the still over), off (enlarges)")
        ->check(oneOf(superResMode, "detail, blend, off"))
        ->type_name("MODE");
    app.add_option("--engine", words.engine,
                   "What computes pictures: gles (shaders), simd (the processor's vector\n"
                   "units; needs no graphics processor), auto (default; the faster one)")
        ->check(oneOf(engineWish, "auto, gles, simd"))
        ->type_name("ENGINE");
    app.add_option("--record", options.recordTo, "Record video and stills into this new folder")
        ->type_name("DIR");
    app.add_option("--frames", options.frames, "End after N pictures")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    app.add_option("--seconds", options.seconds, "End after S seconds")->type_name("S");
    app.add_option("--summary", options.summary,
                   "Write what the run measured to this file at the end (JSON; - prints it)")
        ->type_name("FILE");
    app.add_option("--control", options.control,
                   "Listen for mfarctl at this socket; the group may use it, too")
        ->type_name("SOCKET");
    app.add_flag("--measure", options.measure,
                 "Wait for the graphics processor after each stage, for exact stage times");
    app.add_flag("--validate", options.validate,
                 "Check all that is written on the graphics processor for NaN, infinity and\n"
                 "range, about ten times as slow; what is wrong is told in the log");
}

}  // namespace

CommandLine parseCommandLine(int argc, const char* const* argv) {
    CommandLine line;
    Words words;
    CLI::App app("mfard: lifts a fast video sensor to the resolution of a slow still sensor.\n"
                 "Signals: TERM and INT end it, HUP reads the configuration file again.\n",
                 "mfard");
    app.get_formatter()->column_width(26);
    addInputs(app, line.options, words);
    addOutputs(app, line.options, words);
    app.set_version_flag("--version", "mfard " MFAR_VERSION);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        line.print = app.help();
    } catch (const CLI::CallForVersion& version) {
        line.print = std::string(version.what()) + "\n";
    } catch (const CLI::ParseError& error) {
        throw Failure(ExitCode::Usage, std::string(error.what()) + " (mfard --help explains)");
    }
    // Positive test, so that "nan" is refused.
    const double seconds = line.options.seconds.value_or(1);
    if (!(seconds > 0 && seconds <= 1e7))
        throw Failure(ExitCode::Usage, "--seconds must be more than 0 and at most 1e7");
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
    if (options.recording) config.recording = *options.recording;
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
        throw Failure(ExitCode::BadConfig, "pose.source = \"recorded\" needs a recording");
    (void)configuredTags(config.pose);
    return config;
}

}  // namespace mfar
