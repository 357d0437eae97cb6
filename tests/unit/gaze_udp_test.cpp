// Live gaze over UDP on the loopback interface.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/gaze/udp.hpp"

namespace macula::scene {
namespace {

class Sender {
  public:
    explicit Sender(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
        address_.sin_family = AF_INET;
        address_.sin_port = htons(port);
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    ~Sender() { close(socket_); }
    void send(const std::string& text) const {
        ASSERT_EQ(::sendto(socket_, text.data(), text.size(), 0,
                           reinterpret_cast<const sockaddr*>(&address_), sizeof address_),
                  static_cast<ssize_t>(text.size()));
    }

  private:
    int socket_;
    sockaddr_in address_{};
};

TEST(UdpGaze, IsInvalidUntilTheFirstPacket) {
    UdpGaze gaze(0);
    EXPECT_FALSE(gaze.at(0).valid);
    EXPECT_TRUE(gaze.live());
    EXPECT_NE(gaze.port(), 0);
}

TEST(UdpGaze, TheNewestTimeWinsWhateverTheOrder) {
    UdpGaze gaze(0);
    const Sender sender(gaze.port());
    sender.send("100,0,0,-1");
    sender.send("300,1,0,-1\n");
    sender.send("200,-1,0,-1,1,0.5");
    const GazeSample s = gaze.at(77);
    EXPECT_TRUE(s.valid);
    EXPECT_NEAR(angles_of_direction(s.direction).x, 45.0, 1e-9);
    EXPECT_EQ(s.time_ns, 77);
    EXPECT_EQ(gaze.counts().received, 3u);
    EXPECT_EQ(gaze.counts().stale, 1u);
    EXPECT_EQ(gaze.at(99).time_ns, 77) << "nothing newer came";
}

TEST(UdpGaze, MalformedPacketsAreCountedAndChangeNothing) {
    UdpGaze gaze(0);
    const Sender sender(gaze.port());
    sender.send("5,0,0,-1");
    const std::string bad[] = {"",
                               "x",
                               "6,0,0",
                               "6,abc,0,-1",
                               "6,0,0,-1,7",
                               "6,0,0,-1,1,2",
                               "6,0,0,-1,1,1,1",
                               "1e99,0,0,-1",
                               "6,0,0,-1\n7,0,1,-1",
                               "-6,0,0,-1",
                               std::string(600, '1'),
                               std::string("6,0,\0,-1", 8),
                               "6,0,0,0,1"};
    for (const std::string& packet : bad)
        sender.send(packet);
    EXPECT_EQ(gaze.at(1).direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(gaze.counts().malformed, std::size(bad));
    EXPECT_EQ(gaze.counts().received, std::size(bad) + 1);
    EXPECT_THAT(gaze.status(), testing::HasSubstr("13 malformed"));
}

TEST(UdpGaze, AnInvalidPacketSaysThatTrackingIsLost) {
    UdpGaze gaze(0);
    const Sender sender(gaze.port());
    sender.send("5,0,0,-1");
    sender.send("6,0,0,0,0");
    EXPECT_FALSE(gaze.at(1).valid);
}

TEST(UdpGaze, ATakenPortIsNamed) {
    const UdpGaze first(0);
    EXPECT_THAT([&] { UdpGaze second(first.port()); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::HasSubstr("port " + std::to_string(first.port()))));
}

} // namespace
} // namespace macula::scene
