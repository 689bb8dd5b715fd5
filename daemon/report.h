#pragma once

#include "daemon/run_history.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar {

/// A run as one page of HTML that needs no other file and no scripts: the numbers of summary(),
/// charts of their course, and pictures. The page is well-formed XML, too. Its size is bounded,
/// however long the run was. `written`: the time in words.
[[nodiscard]] std::string reportPage(const nlohmann::ordered_json& summary, RunHistory history,
                                     const RunPictures& pictures, const std::string& written);

}  // namespace mfar
