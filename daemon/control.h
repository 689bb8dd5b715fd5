#pragma once

#include "daemon/control_socket.h"
#include "hal/display.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace mfar {

/// The commands that mfarctl can send. Each may be called from any thread and throws std::exception
/// with one clear sentence when it fails.
struct ControlActions {
    /// The current state, for people and scripts.
    std::function<nlohmann::ordered_json()> status;
    /// Everything measured since the start, see summary().
    std::function<nlohmann::ordered_json()> stats;
    /// The last picture: as finished, or with `screen` as the screen shows it.
    std::function<ScreenPicture(bool screen)> snapshot;
    /// Reads the configuration again. Returns a message about what has changed.
    std::function<std::string()> reload;
    /// Starts a recording into a new folder of this name in the working directory.
    std::function<void(const std::string& name)> record;
    /// Ends the recording and returns a message about it.
    std::function<nlohmann::ordered_json()> stopRecording;
    /// Requests one still.
    std::function<void()> trigger;
    /// Forgets the filters that were learned from both sensors.
    std::function<void()> resetLearning;
};

/// Executes a request: an object with a command and its arguments:
///   {"command": "status"}, "stats", "reload", "trigger"
///   {"command": "snapshot", "screen": false}
///   {"command": "learn", "reset": true}
///   {"command": "record", "name": "walk-1"}, {"command": "record", "stop": true}
/// An answer is {"ok": true, ...} or {"ok": false, "error": "one sentence"}. The answer to snapshot
/// has "width", "height" and "bytes"; that many bytes R G B A follow its line, row 0 first. An
/// observer may only send status and stats. Never throws.
[[nodiscard]] ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                                          ControlRole role = ControlRole::Operator);

/// A valid folder name: letters, digits, dot, hyphen and underscore, at most 100 characters, not
/// beginning with a dot.
[[nodiscard]] bool isFolderName(std::string_view name);

}  // namespace mfar
