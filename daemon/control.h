#pragma once

#include "daemon/control_socket.h"
#include "hal/display.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace mfar {

/// The commands that mfarctl can send. All are thread-safe. If a command fails, it throws a
/// std::exception whose message is one sentence.
struct ControlActions {
    std::function<nlohmann::ordered_json()> status;
    std::function<nlohmann::ordered_json()> stats;
    /// Returns the last finished picture. If `screen` is set, it is the picture as the screen shows
    /// it.
    std::function<ScreenPicture(bool screen)> snapshot;
    /// Reads the configuration again. Returns a message that names the settings that need a
    /// restart.
    std::function<std::string()> reload;
    /// Starts a recording with this name. Returns its folder.
    std::function<std::filesystem::path(const std::string& name)> record;
    /// Ends the recording. Returns its folder, and the numbers of its frames, of its stills and of
    /// dropped pictures.
    std::function<nlohmann::ordered_json()> stopRecording;
    std::function<void()> trigger;
    std::function<void()> resetLearning;
};

/// Executes a request. It is a JSON object with a command and its arguments:
///   {"command": "status"}, also with "stats", "reload" or "trigger"
///   {"command": "snapshot", "screen": false}
///   {"command": "learn", "reset": true}
///   {"command": "record", "name": "walk-1"}, {"command": "record", "stop": true}
/// The answer is {"ok": true, ...} or {"ok": false, "error": "one sentence"}. The answer to
/// snapshot has "width", "height" and "bytes". After the line of this answer, "bytes" bytes follow:
/// the pixels R G B A, row 0 first. The answer to record has "folder". An observer may only send
/// status and stats. Never throws.
[[nodiscard]] ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                                          ControlRole role = ControlRole::Operator);

/// Returns true for 1 to 100 letters, digits, dots, hyphens and underscores that do not begin with
/// a dot.
[[nodiscard]] bool isFolderName(std::string_view name);

}  // namespace mfar
