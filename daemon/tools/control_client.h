#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace mfar {

/// Reports that mfard cannot be reached at the socket or does not answer.
class NotReachable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Reports that mfard refused the request or failed. The message comes from mfard.
class Refused : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Reply {
    nlohmann::ordered_json body;
    /// The bytes after the answer's line; `body` has their number as "bytes".
    std::vector<std::uint8_t> data;
};

/// Sends a request to the mfard that listens at this socket. Waits up to 15 s for each part of the
/// answer, or up to 10 minutes for the end of a recording, which waits for the disk. Throws
/// NotReachable, Refused.
[[nodiscard]] Reply ask(const std::filesystem::path& socket, const nlohmann::json& request);

}  // namespace mfar
