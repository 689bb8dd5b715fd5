#include "daemon/after_output.h"
#include "daemon/exit_code.h"
#include "daemon/tools/control_client.h"
#include "daemon/tools/ctl_arguments.h"
#include "daemon/tools/status_text.h"
#include "hal/virtual/image_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {
namespace {

constexpr int kRefused = 1;

void writePng(const ImageView& picture) {
    std::vector<std::uint8_t> bytes;
    encodePng(picture, bytes);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
    if (!written || std::fflush(stdout) != 0)
        throw std::runtime_error("the picture cannot be written to standard output");
}

void saveSnapshot(const Reply& reply, const std::string& file) {
    const Size size{reply.body.value("width", 0), reply.body.value("height", 0)};
    const bool possible = size.width > 0 && size.height > 0 && size.width <= kMaxImageSide &&
                          size.height <= kMaxImageSide;
    if (!possible || reply.data.size() != std::size_t{4} * size.width * size.height)
        throw Refused("mfard sent an invalid picture");
    const ImageView picture{reply.data.data(), size, std::size_t{4} * size.width,
                            PixelFormat::Rgba8};
    if (file == "-") return writePng(picture);
    savePng(file, picture);
    fmt::print("{}: {}x{}\n", file, size.width, size.height);
}

void run(const CLI::App& app, const CtlArguments& a) {
    const auto wants = [&](const char* command) { return app.got_subcommand(command); };
    nlohmann::json request{{"command", app.get_subcommands().front()->get_name()}};
    if (wants("snapshot")) request["screen"] = a.screen;
    if (wants("learn")) request["reset"] = true;
    if (wants("record") && a.stop) request["stop"] = true;
    if (wants("record") && !a.record.empty()) request["name"] = a.record;
    const Reply reply = ask(a.socket, request);
    if (wants("snapshot")) return saveSnapshot(reply, a.snapshot);
    if (wants("stats")) return fmt::print("{}\n", reply.body.dump(2));
    fmt::print("{}", statusText(reply.body));
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    using namespace mfar;
    CtlParser parser;
    try {
        parser.app.parse(argc, argv);
        run(parser.app, parser.arguments);
        return afterOutput(static_cast<int>(ExitCode::Ok), "mfarctl",
                           static_cast<int>(ExitCode::OutputFailed));
    } catch (const CLI::ParseError& error) {
        if (parser.app.exit(error) != 0) return static_cast<int>(ExitCode::Usage);
        return afterOutput(0, "mfarctl", static_cast<int>(ExitCode::OutputFailed));
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
