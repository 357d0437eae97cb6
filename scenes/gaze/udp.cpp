#include "scenes/gaze/udp.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "scenes/gaze/csv.hpp"
#include "scenes/gaze/recording.hpp"

namespace macula::scene {
namespace {

constexpr std::size_t kMaxPacket = 512;
constexpr int kMaxPacketsAtOnce = 100'000; // a flood must not stop the frame

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

constexpr const char* kTitles[] = {"time_ns", "x", "y", "z", "valid", "confidence"};

// The canonical CSV's own reader, with the columns that the packet has.
GazeSample parse_packet(std::string_view packet) {
    std::size_t values = 1;
    for (const char c : packet)
        values += c == ',' ? 1 : 0;
    if (values < 4 || values > std::size(kTitles) || packet.find('\n') < packet.size() - 1)
        throw SceneError("a packet has 4 to 6 values on one line");
    std::string text;
    for (std::size_t i = 0; i < values; ++i)
        text += std::string(i == 0 ? "" : ",") + kTitles[i];
    const GazeRecording one = parse_gaze_csv(text + '\n' + std::string(packet), "packet");
    return one.samples.at(0);
}

} // namespace

UdpGaze::UdpGaze(std::uint16_t port) {
    const auto fail = [&](const char* what) {
        const int error = errno;
        if (socket_ >= 0)
            close(socket_);
        throw std::runtime_error("gaze over UDP, port " + std::to_string(port) +
                                 " on 127.0.0.1: " + what + ": " + std::strerror(error));
    };
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0)
        fail("making a socket");
    sockaddr_in address = loopback(port);
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        fail("listening");
    socklen_t size = sizeof address;
    if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
        fail("asking for the port");
    port_ = ntohs(address.sin_port);
    newest_.valid = false;
    newest_.confidence = 0.0;
}

UdpGaze::~UdpGaze() {
    close(socket_);
}

void UdpGaze::take(std::string_view packet, std::int64_t time_ns) {
    ++counts_.received;
    GazeSample sample;
    try {
        sample = parse_packet(packet);
    } catch (const SceneError&) {
        ++counts_.malformed;
        return;
    }
    if (any_ && sample.time_ns <= sender_ns_) {
        ++counts_.stale;
        return;
    }
    any_ = true;
    sender_ns_ = sample.time_ns;
    newest_ = sample;
    newest_.time_ns = time_ns;
}

void UdpGaze::receive(std::int64_t time_ns) {
    std::array<char, kMaxPacket + 1> packet{};
    for (int i = 0; i < kMaxPacketsAtOnce; ++i) {
        const ssize_t size = ::recv(socket_, packet.data(), packet.size(), 0);
        if (size < 0 && errno == EINTR)
            continue;
        if (size < 0)
            return;
        if (static_cast<std::size_t>(size) > kMaxPacket) {
            ++counts_.received;
            ++counts_.malformed;
        } else {
            take({packet.data(), static_cast<std::size_t>(size)}, time_ns);
        }
    }
}

GazeSample UdpGaze::at(std::int64_t time_ns) {
    receive(time_ns);
    return newest_;
}

std::string UdpGaze::status() const {
    return describe() + ": " + std::to_string(counts_.received) + " packets, " +
           std::to_string(counts_.malformed) + " malformed, " + std::to_string(counts_.stale) +
           " older than one before";
}

std::string UdpGaze::describe() const {
    return "UDP port " + std::to_string(port_) + " on 127.0.0.1";
}

} // namespace macula::scene
