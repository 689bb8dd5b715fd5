// A simulated service manager. Writes the messages that a service sends to $NOTIFY_SOCKET into a
// file, one per line. Usage: notify-listener SOCKET FILE

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
    if (argc != 3) return 64;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, argv[1], sizeof address.sun_path - 1);
    const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return 69;
    std::FILE* out = std::fopen(argv[2], "ae");
    if (out == nullptr) return 74;
    std::array<char, 4096> text{};
    for (ssize_t n = 0; (n = recv(fd, text.data(), text.size(), 0)) >= 0;) {
        std::fwrite(text.data(), 1, static_cast<std::size_t>(n), out);
        std::fputc('\n', out);
        std::fflush(out);
    }
}
