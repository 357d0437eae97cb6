// Live gaze over UDP, from programs on this machine only.
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/gaze/source.hpp"

namespace macula::scene {

struct UdpCounts {
    std::uint64_t received = 0;
    std::uint64_t malformed = 0; // not of the form below, or not a direction
    std::uint64_t stale = 0;     // older than one received before
};

// Listens on 127.0.0.1. A packet is one line of text: time_ns,x,y,z[,valid[,confidence]], the time
// in the sender's own clock. The packet with the newest time wins, whatever the order of arrival;
// until the first one samples are invalid. at() ignores its argument's value: samples carry the
// time at which they were asked for first.
class UdpGaze : public GazeSource {
  public:
    // Port 0: any free one. Throws std::runtime_error that names port and cause.
    explicit UdpGaze(std::uint16_t port);
    ~UdpGaze() override;
    UdpGaze(const UdpGaze&) = delete;
    UdpGaze& operator=(const UdpGaze&) = delete;

    GazeSample at(std::int64_t time_ns) override;
    bool live() const override { return true; }
    std::string status() const override;
    std::string describe() const override;

    std::uint16_t port() const { return port_; }
    const UdpCounts& counts() const { return counts_; }

  private:
    void receive(std::int64_t time_ns);
    void take(std::string_view packet, std::int64_t time_ns);

    int socket_ = -1;
    std::uint16_t port_ = 0;
    UdpCounts counts_;
    GazeSample newest_;
    std::int64_t sender_ns_ = 0;
    bool any_ = false;
};

} // namespace macula::scene
