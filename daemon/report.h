#pragma once

#include "daemon/run_history.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar {

/// Returns an HTML page about a run. It shows the numbers of summary(), charts of how they changed,
/// and pictures. It needs no other file and no scripts, and it is well-formed XML, too. Its size is
/// limited, however long the run was. `written` is a text for the reader that states when the page
/// was written.
[[nodiscard]] std::string reportPage(const nlohmann::ordered_json& summary, RunHistory history,
                                     const RunPictures& pictures, const std::string& written);

}  // namespace mfar
