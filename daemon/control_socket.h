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

struct ControlAnswer {
    std::string line;
    std::vector<std::uint8_t> data{};
};

/// A Unix stream socket for requests of one line. Each connection carries one request and its
/// answer. Up to four requests are answered at the same time, each by its own thread, because an
/// answer may wait for a disk.
///
/// A client is disconnected if it does not send its request within 2 s or does not read the answer
/// within 5 s. The socket file's permissions let the user and the group of this process connect.
/// roleOfPeer() decides which clients are operators.
class ControlSocket {
public:
    static constexpr std::size_t kLongestRequest = 4096;  ///< [bytes], without the newline

    /// Answers a request, which is passed without its newline. Must not throw. Several threads may
    /// call it at the same time.
    using Handler = std::function<ControlAnswer(std::string_view request, ControlRole role)>;

    /// Creates the socket and begins to listen. Replaces the socket file of a process that has
    /// died. Throws Failure(Unavailable) if another process listens at `path` or the path cannot be
    /// used. The threads of this object register at `hearts`, which must outlive this object.
    ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts = nullptr);
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;
    ~ControlSocket();

private:
    struct Client {
        OwnedFd fd;
        Timestamp end;  ///< end of the time limit for sending the request
        ControlRole role = ControlRole::Observer;
        std::string request{};
        bool isReady = false, isComplete = false, isGone = false;
    };

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
    void send(int client, const void* data, std::size_t bytes, Timestamp end) const;

    std::filesystem::path path_;
    Handler handler_;
    Heartbeats* hearts_;
    std::optional<gid_t> operators_;
    OwnedFd listening_;
    OwnedFd stop_;
    OwnedFd answered_;              ///< eventfd: an answer thread has finished
    std::list<Answering> answers_;  ///< used by thread_ only
    std::thread thread_;
};

}  // namespace mfar
