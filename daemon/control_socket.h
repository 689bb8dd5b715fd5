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

/// What goes back to a client: a line, and what it announces.
struct ControlAnswer {
    std::string line;  ///< without the line end
    std::vector<std::uint8_t> data{};
};

/// A Unix stream socket for requests of one line each. A connection carries one request and its
/// answer. Requests are read side by side and answered side by side, four at most, each by a thread
/// of its own, as one may wait for a disk. A client that is slow is given up: 2 s for its request,
/// 5 s for taking the answer. The owner and the group of this process may connect; who of them is
/// an operator, roleOfPeer() says.
class ControlSocket {
public:
    static constexpr std::size_t kLongestRequest = 4096;  ///< [byte], line end included

    /// Called with a request without its line end, by several threads at once. Must not throw.
    using Handler = std::function<ControlAnswer(std::string_view request, ControlRole role)>;

    /// Makes the socket and begins to listen. One that a dead process has left is replaced. Throws
    /// Failure(Unavailable) when somebody listens there, or the path cannot be used. `hearts`,
    /// which must outlive this, has the thread watched.
    ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts = nullptr);
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;
    /// Gives up what is being served.
    ~ControlSocket();

private:
    struct Client {
        OwnedFd fd;
        Timestamp end;  ///< of its time for the request
        ControlRole role = ControlRole::Observer;
        std::string request{};
        bool isReady = false, isComplete = false, isGone = false;
    };

    /// One request that is being answered.
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
    OwnedFd answered_;              ///< readable when an answer is over
    std::list<Answering> answers_;  ///< of the thread
    std::thread thread_;
};

}  // namespace mfar
