#pragma once

#include "base/heartbeats.h"
#include "base/owned_fd.h"
#include "base/time.h"
#include "daemon/control_role.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace mfar {

/// An answer to a request: a line, and the data that follow the line.
struct ControlAnswer {
    std::string line;  ///< without the newline
    std::vector<std::uint8_t> data{};
};

/// A Unix stream socket for requests of one line. Each connection carries one request and its
/// answer. Several requests are read at the same time. Up to four are answered at the same time,
/// each by its own thread, because an answer may wait for a disk. A client must send its request
/// within 2 s and read the answer within 5 s; otherwise it is disconnected. The socket file's
/// permissions let the user and the group of this process connect. roleOfPeer() decides which
/// clients are operators.
class ControlSocket {
public:
    static constexpr std::size_t kLongestRequest = 4096;  ///< [bytes], including the newline

    /// Answers a request, which is passed without its newline. Several threads may call the handler
    /// at the same time. It must not throw.
    using Handler = std::function<ControlAnswer(std::string_view request, ControlRole role)>;

    /// Creates the socket and begins to listen. If the socket file of a process that has died
    /// exists, it is replaced. Throws Failure(Unavailable) if another process listens at `path` or
    /// the path cannot be used. The threads register at `hearts`, which must outlive this object.
    ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts = nullptr);
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;
    /// Disconnects all clients.
    ~ControlSocket();

private:
    struct Client {
        OwnedFd fd;
        Timestamp end;  ///< time until which the client must have sent its request
        ControlRole role = ControlRole::Observer;
        std::string request{};
        bool isReady = false, isComplete = false, isGone = false;
    };

    /// A request that is being answered.
    struct Answering {
        Client client;
        std::atomic<bool> isOver{false};
        std::jthread thread{};
    };

    void serve();
    void startAnswers(std::vector<Client>& clients);
    [[nodiscard]] bool waitFor(std::vector<Client>& clients);
    [[nodiscard]] bool accept(std::vector<Client>& clients);
    static void read(Client& client);
    void answer(Answering& one);
    [[nodiscard]] bool isReady(int fd, short events, int timeoutMs) const;
    void send(int client, const void* data, std::size_t bytes) const;

    std::filesystem::path path_;
    Handler handler_;
    Heartbeats* hearts_;
    std::optional<gid_t> operators_;
    OwnedFd listening_;
    OwnedFd stop_;
    OwnedFd answered_;              ///< eventfd, readable when an answer thread has finished
    std::list<Answering> answers_;  ///< only thread_ uses this
    std::thread thread_;
};

}  // namespace mfar
