#include "daemon/control.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kLongestName = 100;
constexpr std::array<std::string_view, 7> kCommands{"status", "stats",   "snapshot", "reload",
                                                    "record", "trigger", "learn"};

class BadRequest : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

json parsed(std::string_view request) {
    if (request.size() > ControlSocket::kLongestRequest)
        throw BadRequest(
            fmt::format("the request is longer than {} bytes", ControlSocket::kLongestRequest));
    json out = json::parse(request, nullptr, false);
    if (!out.is_object() || !out.contains("command") || !out["command"].is_string())
        throw BadRequest(R"(a request must be one line of JSON like {"command": "status"})");
    return out;
}

void allowOnly(const json& request, std::initializer_list<std::string_view> arguments) {
    for (const auto& [key, value] : request.items())
        if (key != "command" && std::ranges::find(arguments, key) == arguments.end())
            throw BadRequest(fmt::format("command {} takes no argument \"{}\"",
                                         request["command"].get<std::string>(), key));
}

bool flag(const json& request, const char* key) {
    const auto found = request.find(key);
    if (found == request.end()) return false;
    if (!found->is_boolean()) throw BadRequest(fmt::format("\"{}\" must be true or false", key));
    return found->get<bool>();
}

ordered_json with(const ordered_json& more = ordered_json::object()) {
    ordered_json out = {{"ok", true}};
    out.update(more);
    return out;
}

ControlAnswer line(const ordered_json& body) {
    // Bytes that are not UTF-8 are replaced, because a device's name may contain any bytes.
    return {body.dump(-1, ' ', false, ordered_json::error_handler_t::replace)};
}

ControlAnswer snapshot(const ControlActions& actions, const json& request) {
    allowOnly(request, {"screen"});
    ScreenPicture picture = actions.snapshot(flag(request, "screen"));
    if (picture.format == PixelFormat::Bgra8)
        for (std::size_t i = 0; i + 3 < picture.pixels.size(); i += 4)
            std::swap(picture.pixels[i], picture.pixels[i + 2]);
    ControlAnswer answer = line(with({{"width", picture.size.width},
                                      {"height", picture.size.height},
                                      {"bytes", picture.pixels.size()}}));
    answer.data = std::move(picture.pixels);
    return answer;
}

ControlAnswer record(const ControlActions& actions, const json& request) {
    allowOnly(request, {"name", "stop"});
    const auto name = request.find("name");
    if (flag(request, "stop") != (name == request.end()))
        throw BadRequest(
            R"(record needs a "name" to start a recording, or "stop": true to end it)");
    if (name == request.end()) return line(with(actions.stopRecording()));
    if (name->is_string() && name->get<std::string>().size() > kLongestName)
        throw BadRequest(fmt::format("a recording's name must have at most {} characters, not {}",
                                     kLongestName, name->get<std::string>().size()));
    if (!name->is_string() || !isFolderName(name->get<std::string>()))
        throw BadRequest("a recording's name must consist of letters, digits, '.', '-' and '_', "
                         "and must not begin with '.'");
    return line(with({{"folder", actions.record(name->get<std::string>()).string()}}));
}

ControlAnswer learn(const ControlActions& actions, const json& request) {
    allowOnly(request, {"reset"});
    if (!flag(request, "reset")) throw BadRequest(R"(learn needs "reset": true)");
    actions.resetLearning();
    return line(with());
}

std::string_view deedOf(std::string_view command) {
    if (command == "snapshot") return "take a snapshot";
    if (command == "trigger") return "request a still";
    return command == "learn" ? "reset what was learned" : command;
}

void requireRole(const std::string& command, ControlRole role) {
    if (role == ControlRole::Operator || command == "status" || command == "stats") return;
    throw BadRequest(
        fmt::format("only root, the user that runs mfard, and members of group {} may {}",
                    kOperatorsGroup, deedOf(command)));
}

ControlAnswer done(const ControlActions& actions, const json& request, ControlRole role) {
    const auto command = request["command"].get<std::string>();
    if (std::ranges::find(kCommands, command) == std::end(kCommands))
        throw BadRequest(fmt::format("unknown command \"{}\"; expected one of {}", command,
                                     fmt::join(kCommands, ", ")));
    requireRole(command, role);
    if (command == "snapshot") return snapshot(actions, request);
    if (command == "record") return record(actions, request);
    if (command == "learn") return learn(actions, request);
    allowOnly(request, {});
    if (command == "status") return line(with(actions.status()));
    if (command == "stats") return line(with(actions.stats()));
    if (command == "reload") return line(with({{"message", actions.reload()}}));
    actions.trigger();
    return line(with());
}

}  // namespace

ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                            ControlRole role) {
    try {
        return done(actions, parsed(request), role);
    } catch (const std::exception& error) {
        return line({{"ok", false}, {"error", error.what()}});
    }
}

bool isFolderName(std::string_view name) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '.' || c == '-' || c == '_';
    };
    return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
           std::ranges::all_of(name, fits);
}

}  // namespace mfar
