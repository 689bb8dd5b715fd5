#include "daemon/exit_code.h"
#include "daemon/tools/control_client.h"
#include "hal/virtual/image_files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>

namespace mfar {
namespace {

constexpr int kRefused = 1;

struct Arguments {
    std::string socket = "/run/mfar/control";
    std::string snapshot;
    bool screen = false;
    std::string record;
    bool stop = false;
};

void print(const nlohmann::ordered_json& body) {
    for (const auto& [key, value] : body.items())
        fmt::print("{:<11}{}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
}

void saveSnapshot(const Reply& reply, const std::string& file) {
    const Size size{reply.body.value("width", 0), reply.body.value("height", 0)};
    const bool possible = size.width > 0 && size.height > 0 && size.width <= kMaxImageSide &&
                          size.height <= kMaxImageSide;
    if (!possible || reply.data.size() != std::size_t{4} * size.width * size.height)
        throw Refused("mfard sent an invalid picture");
    savePng(file, {reply.data.data(), size, std::size_t{4} * size.width, PixelFormat::Rgba8});
    fmt::print("{}: {}x{}\n", file, size.width, size.height);
}

void run(const CLI::App& app, const Arguments& a) {
    const auto wants = [&](const char* command) { return app.got_subcommand(command); };
    nlohmann::json request{{"command", app.get_subcommands().front()->get_name()}};
    if (wants("snapshot")) request["screen"] = a.screen;
    if (wants("learn")) request["reset"] = true;
    if (wants("record") && a.stop) request["stop"] = true;
    if (wants("record") && !a.record.empty()) request["name"] = a.record;
    const Reply reply = ask(a.socket, request);
    if (wants("snapshot")) return saveSnapshot(reply, a.snapshot);
    if (wants("stats")) return fmt::print("{}\n", reply.body.dump(2));
    print(reply.body);
}

void declare(CLI::App& app, Arguments& a) {
    app.add_option("--socket", a.socket, "Socket on which mfard listens (its option --control)")
        ->capture_default_str()
        ->type_name("SOCKET");
    app.add_subcommand("status", "Show the state of mfard");
    app.add_subcommand("stats", "Show everything that mfard has measured since its start (JSON)");
    app.add_subcommand("reload", "Read the configuration file again");
    app.add_subcommand("trigger", "Take one still");
    CLI::App* snapshot = app.add_subcommand("snapshot", "Save the last picture of mfard");
    snapshot->add_option("FILE", a.snapshot, "PNG file")->required();
    snapshot->add_flag("--screen", a.screen, "Save the picture as the screen shows it");
    CLI::App* record = app.add_subcommand("record", "Record video and stills");
    CLI::Option* name = record->add_option("NAME", a.record,
                                           "New folder in mfard's working directory, which is\n"
                                           "/var/lib/mfar for the service");
    record->add_flag("--stop", a.stop, "End the recording")->excludes(name);
    app.add_subcommand("learn", "Manage the filters learned from both sensors")
        ->require_subcommand(1)
        ->add_subcommand("reset", "Forget the learned filters and start learning again");
    app.require_subcommand(1);
    app.set_version_flag("--version", "mfarctl " MFAR_VERSION);
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    using namespace mfar;
    CLI::App app("mfarctl: queries and controls a running mfard.\n", "mfarctl");
    Arguments arguments;
    declare(app, arguments);
    try {
        app.parse(argc, argv);
        run(app, arguments);
        return static_cast<int>(ExitCode::Ok);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
    } catch (const NotReachable& error) {
        fmt::print(stderr, "mfarctl: {}\n", error.what());
        return static_cast<int>(ExitCode::Unavailable);
    } catch (const Refused& error) {
        fmt::print(stderr, "mfarctl: {}\n", error.what());
        return kRefused;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfarctl: {}\n", error.what());
        return static_cast<int>(ExitCode::OutputFailed);
    }
}
