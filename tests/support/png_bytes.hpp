// PNG files as no writer of ours makes them: any bit depth, colour type and claimed size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace macula::test {

class PngBytes {
  public:
    // `rows`: of samples, most significant byte first. Colour types: 0 grey, 2 RGB, 6 RGBA.
    static std::string make(std::uint32_t width, std::uint32_t height, unsigned bits,
                            unsigned colour_type, const std::vector<std::string>& rows) {
        std::string filtered;
        for (const std::string& row : rows)
            filtered += '\0' + row; // no filter
        std::string header = number(width) + number(height);
        header += static_cast<char>(bits);
        header += static_cast<char>(colour_type);
        header += std::string(3, '\0');
        return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored(filtered)) +
               chunk("IEND", "");
    }

  private:
    static std::string number(std::uint32_t x) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += static_cast<char>(x >> shift & 255u);
        return bytes;
    }
    static std::string chunk(const std::string& type, const std::string& data) {
        std::uint32_t crc = ~0u;
        for (const char c : type + data) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit)
                crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
        }
        return number(static_cast<std::uint32_t>(data.size())) + type + data + number(~crc);
    }
    // A zlib stream of one stored block; at most 65535 bytes.
    static std::string stored(const std::string& data) {
        const auto size = static_cast<std::uint16_t>(data.size());
        std::uint32_t a = 1, b = 0;
        for (const char c : data) {
            a = (a + static_cast<unsigned char>(c)) % 65521;
            b = (b + a) % 65521;
        }
        std::string stream = "\x78\x01\x01";
        for (const std::uint16_t part : {size, static_cast<std::uint16_t>(~size)}) {
            stream += static_cast<char>(part & 255u);
            stream += static_cast<char>(part >> 8u);
        }
        return stream + data + number(b << 16 | a);
    }
};

} // namespace macula::test
