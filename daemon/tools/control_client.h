#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace mfar {

/// No mfard answers at the socket.
class NotReachable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// mfard has answered that it will not, or cannot; the message is its own.
class Refused : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What mfard answers to a request, see answerControl().
struct Reply {
    nlohmann::ordered_json body;
    std::vector<std::uint8_t> data;  ///< as many as body's "bytes" says
};

/// Sends a request to the mfard that listens at this socket and waits for its answer, 15 s at most.
/// Throws NotReachable, Refused.
[[nodiscard]] Reply ask(const std::filesystem::path& socket, const nlohmann::json& request);

}  // namespace mfar
