#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace mfar {

/// Reports that no mfard listens at the socket.
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
    std::vector<std::uint8_t> data;  ///< follows the line; "bytes" in `body` is its size
};

/// Sends a request to the mfard that listens at this socket. Waits up to 15 s for the answer.
/// Throws NotReachable, Refused.
[[nodiscard]] Reply ask(const std::filesystem::path& socket, const nlohmann::json& request);

}  // namespace mfar
