#pragma once

#include "daemon/run_history.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar {

/// Makes a page of HTML about a run. It has the numbers of summary(), charts of how they changed,
/// and pictures. It needs no other file and no scripts, and it is well-formed XML, too. Its size
/// has a limit, however long the run was. `written` says when it was written, as a text for the
/// reader.
[[nodiscard]] std::string reportPage(const nlohmann::ordered_json& summary, RunHistory history,
                                     const RunPictures& pictures, const std::string& written);

}  // namespace mfar
