#pragma once

#include "daemon/control_socket.h"
#include "hal/display.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace mfar {

/// The commands that mfarctl can send. All are thread-safe. If a command fails, it throws a
/// std::exception whose message is one sentence.
struct ControlActions {
    /// Returns the current state, for people and scripts.
    std::function<nlohmann::ordered_json()> status;
    /// Returns all measurements since the start, see summary().
    std::function<nlohmann::ordered_json()> stats;
    /// Returns the last finished picture as the display got it, or, if `screen` is set, as the
    /// screen shows it.
    std::function<ScreenPicture(bool screen)> snapshot;
    /// Reads the configuration again. Returns a message that names the settings that need a
    /// restart.
    std::function<std::string()> reload;
    /// Starts a recording into a new folder `name` in the working directory.
    std::function<void(const std::string& name)> record;
    /// Ends the recording. Returns how many frames and stills it has and how many were dropped.
    std::function<nlohmann::ordered_json()> stopRecording;
    /// Requests one still.
    std::function<void()> trigger;
    /// Deletes the learned filters.
    std::function<void()> resetLearning;
};

/// Executes a request. It is a JSON object with a command and its arguments:
///   {"command": "status"}, also with "stats", "reload" or "trigger"
///   {"command": "snapshot", "screen": false}
///   {"command": "learn", "reset": true}
///   {"command": "record", "name": "walk-1"}, {"command": "record", "stop": true}
/// The answer is {"ok": true, ...} or {"ok": false, "error": "one sentence"}. The answer to
/// snapshot has "width", "height" and "bytes". After the line of this answer, "bytes" bytes follow:
/// the pixels R G B A, row 0 first. An observer may only send status and stats. Never throws.
[[nodiscard]] ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                                          ControlRole role = ControlRole::Operator);

/// Returns whether a folder's name is allowed: at most 100 letters, digits, dots, hyphens and
/// underscores, the first of which is not a dot.
[[nodiscard]] bool isFolderName(std::string_view name);

}  // namespace mfar
