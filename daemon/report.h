#pragma once

#include "daemon/run_history.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar {

/// Returns an HTML page about a run: the numbers of summary(), charts of the numbers over time, and
/// pictures. The page needs no other file and no scripts, and is well-formed XML. Its size is
/// limited, however long the run was. `written` tells the reader when the page was written.
[[nodiscard]] std::string reportPage(const nlohmann::ordered_json& summary, RunHistory history,
                                     const RunPictures& pictures, const std::string& written);

}  // namespace mfar
