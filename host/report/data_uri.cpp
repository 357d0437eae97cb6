#include "host/report/data_uri.hpp"

#include <cstdint>

namespace macula::report {
namespace {

const char* media_type(std::string_view content) {
    using namespace std::string_view_literals;
    if (content.starts_with("\x89PNG\r\n\x1a\n"sv))
        return "image/png";
    if (content.starts_with("\xff\xd8\xff"sv))
        return "image/jpeg";
    if (content.starts_with("RIFF"sv) && content.size() > 12 && content.substr(8, 4) == "WEBP"sv)
        return "image/webp";
    return nullptr;
}

} // namespace

std::string base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group <<= 8;
            if (i + k < bytes.size())
                group |= static_cast<unsigned char>(bytes[i + k]);
        }
        const std::size_t known = bytes.size() - i; // 1 and 2 leave two and one digits out
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= known ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string data_uri(std::string_view content) {
    const char* type = media_type(content);
    return type == nullptr ? "" : "data:" + std::string(type) + ";base64," + base64(content);
}

} // namespace macula::report
