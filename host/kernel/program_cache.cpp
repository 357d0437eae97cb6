#include "host/kernel/program_cache.hpp"

#include <unistd.h>

#include <xxhash.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace macula::kernel {
namespace {

namespace fs = std::filesystem;

struct Header {
    std::array<char, 8> magic{'M', 'A', 'C', 'U', 'L', 'A', 'P', '1'};
    std::uint64_t key_bytes = 0;
    std::uint64_t binary_bytes = 0;
    /// Of the key and the binary, one after the other.
    std::uint64_t checksum = 0;
};

std::uint64_t checksum_of(const void* data, std::size_t bytes) {
    return XXH3_64bits(data, bytes);
}

const char* environment(const char* name) {
    const char* value = std::getenv(name);
    return value && *value ? value : nullptr;
}

/// Unique among processes and threads, beside the file it will become.
fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    std::string name = path.string();
    for (const std::string& part : {std::to_string(getpid()), std::to_string(counter++)})
        (name += '.') += part;
    return name += ".part";
}

bool write_file(const fs::path& path, const Header& header, const std::string& body) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    file.write(body.data(), static_cast<std::streamsize>(body.size()));
    file.close();
    return static_cast<bool>(file);
}

} // namespace

ProgramCache::ProgramCache(fs::path folder) : folder_(std::move(folder)) {}

fs::path ProgramCache::default_folder() {
    if (const char* folder = environment("MACULA_CACHE_DIR"))
        return folder;
    if (const char* cache = environment("XDG_CACHE_HOME"))
        return fs::path(cache) / "macula";
    if (const char* home = environment("HOME"))
        return fs::path(home) / ".cache" / "macula";
    return {};
}

fs::path ProgramCache::path_of(const std::string& key) const {
    const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
    std::array<char, 33> name{};
    std::snprintf(name.data(), name.size(), "%016llx%016llx",
                  static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    return folder_ / "programs" / (std::string(name.data()) + ".clbin");
}

std::optional<std::vector<std::byte>> ProgramCache::load(const std::string& key) const {
    if (folder_.empty())
        return std::nullopt;
    std::ifstream file(path_of(key), std::ios::binary);
    if (!file)
        return std::nullopt;
    const std::string text(std::istreambuf_iterator<char>(file), {});
    Header header;
    if (text.size() < sizeof header)
        return std::nullopt;
    std::memcpy(&header, text.data(), sizeof header);
    const char* body = text.data() + sizeof header;
    const std::size_t body_bytes = text.size() - sizeof header;
    if (header.magic != Header{}.magic || header.key_bytes != key.size() ||
        body_bytes <= key.size() || header.binary_bytes != body_bytes - key.size() ||
        std::memcmp(body, key.data(), key.size()) != 0 ||
        header.checksum != checksum_of(body, body_bytes))
        return std::nullopt;
    std::vector<std::byte> binary(header.binary_bytes);
    std::memcpy(binary.data(), body + key.size(), binary.size());
    return binary;
}

void ProgramCache::store(const std::string& key, std::span<const std::byte> binary) const {
    if (folder_.empty() || binary.empty())
        return;
    std::string body = key;
    body.append(reinterpret_cast<const char*>(binary.data()), binary.size());
    Header header;
    header.key_bytes = key.size();
    header.binary_bytes = binary.size();
    header.checksum = checksum_of(body.data(), body.size());
    const fs::path path = path_of(key);
    const fs::path temporary = temporary_name(path);
    std::error_code problem;
    fs::create_directories(path.parent_path(), problem);
    if (problem)
        return;
    if (write_file(temporary, header, body))
        fs::rename(temporary, path, problem);
    else
        problem = std::make_error_code(std::errc::io_error);
    if (problem)
        fs::remove(temporary, problem);
}

} // namespace macula::kernel
