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

/// An answer: a line, and the data that the line announces.
struct ControlAnswer {
    std::string line;  ///< without the line end
    std::vector<std::uint8_t> data{};
};

/// A Unix stream socket for requests of one line each. A connection carries one request and its
/// answer. Requests are read concurrently; up to four are answered at once, each by a thread of its
/// own, as an answer may wait for a disk. A client may take 2 s to send its request and 5 s to take
/// the answer, then it is dropped. The owner and the group of this process may connect;
/// roleOfPeer() decides which of them is an operator.
class ControlSocket {
public:
    static constexpr std::size_t kLongestRequest = 4096;  ///< [byte], line end included

    /// Called with a request without its line end, by several threads at once. Must not throw.
    using Handler = std::function<ControlAnswer(std::string_view request, ControlRole role)>;

    /// Creates the socket and begins to listen. A socket file that a dead process has left is
    /// replaced. Throws Failure(Unavailable) when a process listens there, or the path cannot be
    /// used. The threads register with `hearts`, which must outlive this.
    ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts = nullptr);
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;
    /// Drops the requests in progress.
    ~ControlSocket();

private:
    struct Client {
        OwnedFd fd;
        Timestamp end;  ///< when the client's time for the request is over
        ControlRole role = ControlRole::Observer;
        std::string request{};
        bool isReady = false, isComplete = false, isGone = false;
    };

    /// A request in progress.
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
    OwnedFd answered_;              ///< readable when an answer is finished
    std::list<Answering> answers_;  ///< used by thread_ only
    std::thread thread_;
};

}  // namespace mfar
