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
/// std::exception with a message for the user. The message has several lines if a reloaded
/// configuration has several faults.
struct ControlActions {
    std::function<nlohmann::ordered_json()> status;
    std::function<nlohmann::ordered_json()> stats;
    /// Returns the last finished picture. If `screen` is true, returns it in the form in which the
    /// screen shows it.
    std::function<ScreenPicture(bool screen)> snapshot;
    /// Reads the configuration again. Returns a message that names the changed settings that need
    /// a restart.
    std::function<std::string()> reload;
    /// Starts a recording with this name. Returns its folder.
    std::function<std::filesystem::path(const std::string& name)> record;
    /// Ends the recording. Returns its folder and three numbers: recorded frames, recorded stills,
    /// and pictures that could not be recorded.
    std::function<nlohmann::ordered_json()> stopRecording;
    std::function<void()> trigger;
    std::function<void()> resetLearning;
};

/// Executes a request and returns the answer. A request is a JSON object with a command and its
/// arguments:
///   {"command": "status"}, or in the same way with "stats", "reload" or "trigger"
///   {"command": "snapshot", "screen": false}
///   {"command": "learn", "reset": true}
///   {"command": "record", "name": "walk-1"}, {"command": "record", "stop": true}
/// The answer is one line: {"ok": true, ...} or {"ok": false, "error": "message"}. The answer
/// to "record" has "folder". The answer to "snapshot" has "width", "height" and "bytes". After this
/// line, the pixels follow, "bytes" bytes in total: R G B A, row 0 first. ControlRole::Observer may
/// only send "status" and "stats". Never throws.
[[nodiscard]] ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                                          ControlRole role = ControlRole::Operator);

/// Returns true if `name` consists of 1 to 100 letters, digits, dots, hyphens and underscores, and
/// does not begin with a dot.
[[nodiscard]] bool isFolderName(std::string_view name);

}  // namespace mfar
