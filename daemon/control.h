#pragma once

#include "daemon/control_socket.h"
#include "hal/display.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace mfar {

/// What mfard does on demand. Each may be called from any thread and throws std::exception with
/// one clear sentence when it cannot be done.
struct ControlActions {
    /// How it is, for people and scripts.
    std::function<nlohmann::ordered_json()> status;
    /// Everything measured since the start, see summary().
    std::function<nlohmann::ordered_json()> stats;
    /// The last picture, as finished or as `screen`, that is as the screen shows it.
    std::function<ScreenPicture(bool screen)> snapshot;
    /// Reads the configuration again. Returns what that has changed, in words.
    std::function<std::string()> reload;
    /// Begins to record into a new folder of this name in the working directory.
    std::function<void(const std::string& name)> record;
    /// Ends that and returns what was recorded.
    std::function<nlohmann::ordered_json()> stopRecording;
    /// Asks for one still.
    std::function<void()> trigger;
    /// Forgets the filters that were learned from both sensors.
    std::function<void()> resetLearning;
};

/// Does what a request asks for. A request is an object with a command and its arguments:
///   {"command": "status"}, "stats", "reload", "trigger"
///   {"command": "snapshot", "screen": false}
///   {"command": "learn", "reset": true}
///   {"command": "record", "name": "walk-1"}, {"command": "record", "stop": true}
/// An answer is {"ok": true, ...} or {"ok": false, "error": "one sentence"}. That of snapshot says
/// "width", "height" and "bytes", and so many bytes R G B A follow its line, row 0 first. An
/// observer may ask for status and stats alone. Never throws.
[[nodiscard]] ControlAnswer answerControl(const ControlActions& actions, std::string_view request,
                                          ControlRole role = ControlRole::Operator);

/// A name of one folder: letters, digits, dot, hyphen and underscore, at most 100, and no dot at
/// its beginning.
[[nodiscard]] bool isFolderName(std::string_view name);

}  // namespace mfar
